// ofm-slam vocabulary: makes, converts and describes the words that places are recognised by.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "interrupt.h"
#include "ofm/base/error.h"
#include "ofm/features/dbow2_file.h"
#include "ofm/features/default_vocabulary.h"
#include "ofm/features/orb_extractor.h"
#include "ofm/features/vocabulary_file.h"
#include "ofm/features/vocabulary_training.h"
#include "ofm/io/image_file.h"
#include "share_bar.h"

namespace ofm {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFooter =
    "A vocabulary divides image features into words; places are recognised by the words that they\n"
    "share. One is built in, made from simulated rooms. One of your own, from some hundred images\n"
    "of places like those that you will map, finds more of them again.\n"
    "Examples:\n"
    "  ofm-slam vocabulary train office/rgb --output office.voc\n"
    "  ofm-slam vocabulary train a/rgb b/rgb/*.png --step 5 --output both.voc\n"
    "  ofm-slam vocabulary info office.voc\n"
    "  ofm-slam run office --vocabulary office.voc";

constexpr const char* kTrainFooter =
    "IMAGES are PNG or JPEG files, and folders of them. Their features are clustered into a tree "
    "of\n"
    "branching^depth words at most; a word needs some dozen features: 10^4 words want about 500\n"
    "images. The same images, options and seed give the same file. Ctrl-C leaves no file behind.";

constexpr const char* kImportFooter =
    "FILE is a text vocabulary as of DBoW2, unpacked. Its descriptors must compare the same "
    "pixels\n"
    "as ours do to be of much use: ORBvoc.txt was made for another pattern than ofm-slam's, and\n"
    "tells places apart less well than one that ofm-slam trained.";

struct VocabularyArguments {
  std::vector<fs::path> images;
  fs::path file, output;
  int step = 1;
  std::uint64_t seed = 1;
  bool quiet = false;
  VocabularyTrainingOptions training;
  OrbOptions features;
};

bool IsImage(const fs::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

/// Every `step`-th of the files, with folders replaced by the images in them, by name.
std::vector<fs::path> ListImages(const VocabularyArguments& arguments) {
  std::vector<fs::path> all;
  for (const fs::path& path : arguments.images) {
    if (!fs::is_directory(path)) {
      all.push_back(path);
      continue;
    }
    std::vector<fs::path> inside;
    for (const auto& entry : fs::directory_iterator(path)) {
      if (IsImage(entry.path())) inside.push_back(entry.path());
    }
    if (inside.empty())
      throw Error(path, "has no PNG or JPEG files; give the folder of the images");
    std::ranges::sort(inside);
    all.insert(all.end(), inside.begin(), inside.end());
  }
  std::vector<fs::path> chosen;
  for (std::size_t i = 0; i < all.size(); i += static_cast<std::size_t>(arguments.step)) {
    chosen.push_back(all[i]);
  }
  return chosen;
}

[[noreturn]] void FailInterrupted() { throw Error("interrupted; no vocabulary was written"); }

std::vector<std::vector<Descriptor>> DescribeImages(const VocabularyArguments& arguments,
                                                    const std::stop_token& stop) {
  const std::vector<fs::path> paths = ListImages(arguments);
  OrbExtractor extractor(arguments.features);
  std::vector<std::vector<Descriptor>> images;
  std::optional<ShareBar> bar;
  if (!arguments.quiet) bar.emplace("features of the images");
  for (const fs::path& path : paths) {
    if (stop.stop_requested()) FailInterrupted();
    cv::Mat gray;
    cv::cvtColor(LoadColorImage(path), gray, cv::COLOR_BGR2GRAY);
    images.push_back(extractor.Extract(gray).descriptors);
    if (bar) bar->OnShare(static_cast<double>(images.size()) / static_cast<double>(paths.size()));
  }
  return images;
}

void PrintInfo(const Vocabulary& vocabulary) {
  fmt::print("{} words, {} nodes, up to {} children, {} levels, {:.2f} MB\n",
             vocabulary.word_count(), vocabulary.node_count(), vocabulary.branching(),
             vocabulary.depth(), static_cast<double>(EncodeVocabulary(vocabulary).size()) / 1e6);
}

std::optional<Vocabulary> Cluster(const VocabularyArguments& arguments,
                                  std::span<const std::vector<Descriptor>> images,
                                  const std::stop_token& stop) {
  ShareBar bar("words");
  TrainingWatch watch{{}, stop};
  if (!arguments.quiet) watch.progress = [&bar](double share) { bar.OnShare(share); };
  return TrainVocabulary(images, arguments.training, MakeRandomEngine(arguments.seed, 0), watch);
}

void Train(const VocabularyArguments& arguments) {
  cv::setNumThreads(1);  // as in run
  const InterruptStop interrupt;
  const auto images = DescribeImages(arguments, interrupt.token());
  const auto vocabulary = Cluster(arguments, images, interrupt.token());
  if (!vocabulary) FailInterrupted();
  SaveVocabulary(arguments.output, *vocabulary);
  PrintInfo(*vocabulary);
  fmt::print("from {} images, in {}\n", images.size(), arguments.output.string());
}

void Import(const VocabularyArguments& arguments) {
  const Vocabulary vocabulary = LoadDbow2Vocabulary(arguments.file);
  SaveVocabulary(arguments.output, vocabulary);
  PrintInfo(vocabulary);
  fmt::print("in {}\n", arguments.output.string());
}

void AddTrain(CLI::App& command, const std::shared_ptr<VocabularyArguments>& arguments) {
  CLI::App* train = command.add_subcommand("train", "Make a vocabulary from images");
  train->footer(kTrainFooter);
  train->add_option("IMAGES", arguments->images, "Images, or folders of images")->required();
  train->add_option("--output,-o", arguments->output, "The file to write")->required();
  train->add_option("--step", arguments->step, "Take each n-th image only")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  train->add_option("--branching", arguments->training.branching, "Children of a node at most")
      ->check(CLI::Range(2, 255))
      ->capture_default_str();
  train->add_option("--depth", arguments->training.depth, "Levels of the tree")
      ->check(CLI::Range(1, 10))
      ->capture_default_str();
  train->add_option("--features", arguments->features.count, "Features per image")
      ->check(CLI::Range(50, 20000))
      ->capture_default_str();
  train->add_option("--seed", arguments->seed, "Decides the first guess of the clusters")
      ->capture_default_str();
  train->add_flag("--quiet", arguments->quiet, "No progress bar");
  train->callback([arguments] { Train(*arguments); });
}

}  // namespace

void AddVocabularyCommand(CLI::App& app) {
  auto arguments = std::make_shared<VocabularyArguments>();
  CLI::App* command =
      app.add_subcommand("vocabulary", "Make or import the words that places are recognised by");
  command->footer(kFooter);
  command->require_subcommand(1);
  AddTrain(*command, arguments);

  CLI::App* import = command->add_subcommand("import", "Convert a DBoW2 text vocabulary");
  import->footer(kImportFooter);
  import->add_option("FILE", arguments->file, "Path of the text file")->required();
  import->add_option("--output,-o", arguments->output, "The file to write")->required();
  import->callback([arguments] { Import(*arguments);
});

CLI::App* info = command->add_subcommand("info", "Check a vocabulary and print its size");
info->add_option("FILE", arguments->file, "Path of the file; without it, the one built in");
info->callback([arguments] {
  PrintInfo(arguments->file.empty() ? DefaultVocabulary() : LoadVocabulary(arguments->file));
});
}  // namespace ofm

}  // namespace ofm
