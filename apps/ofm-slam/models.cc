// ofm-slam models: which networks there are, getting one, and knowing that it is the right one.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <ostream>
#include <string>

#include "commands.h"
#include "download.h"
#include "download_bar.h"
#include "interrupt.h"
#include "known_models.h"
#include "ofm/base/error.h"
#include "ofm/io/atomic_file.h"
#include "ofm/io/sha256.h"

namespace ofm {
namespace {

constexpr const char* kFooter =
    "The networks are not part of ofm-slam and have licences of their own. Without a connection:\n"
    "fetch the file from its address on a machine that has one, copy it here, and let\n"
    "'ofm-slam models verify FILE' tell whether it arrived whole. A file whose SHA-256 nobody\n"
    "publishes is taken as it comes, and its SHA-256 is printed; --sha256 pins it the next time.\n"
    "Examples:\n"
    "  ofm-slam models\n"
    "  ofm-slam models download mask-rcnn-inception-v2 --to models\n"
    "  ofm-slam models verify models/mask_rcnn_inception_v2_coco_2018_01_28.tar.gz";

struct ModelsArguments {
  std::string name, from, sha256;
  std::filesystem::path to = "models", file;
  bool quiet = false;
};

std::string SizeOf(const KnownModel& model) {
  return model.bytes == 0 ? "?" : fmt::format("{:.1f} MB", static_cast<double>(model.bytes) / 1e6);
}

void ListModels() {
  fmt::print("{:<29} {:<19} {:>8}  {}\n", "NAME", "LICENCE", "SIZE", "SHA-256");
  for (const KnownModel& model : KnownModels()) {
    const char* no_hash =
        model.make.empty() ? "not published; printed after the download" : "not published";
    fmt::print("{:<29} {:<19} {:>8}  {}\n", model.name, model.licence, SizeOf(model),
               model.sha256.empty() ? no_hash : model.sha256);
    fmt::print("    {:<8} {}\n", model.make.empty() ? "file" : "weights", model.address);
    if (!model.make.empty()) fmt::print("    {:<8} {}\n", "make", model.make);
    fmt::print("    {:<8} {}\n", "use", model.use);
    if (!model.sha256.empty()) fmt::print("    {:<8} {}\n", "SHA-256:", model.sha256_source);
  }
  fmt::print("\n{}\n", kFooter);
}

const KnownModel& ModelOf(const std::string& name) {
  const KnownModel* model = FindModelByName(name);
  if (model == nullptr) {
    throw Error(fmt::format("no model is called '{}'; ofm-slam models lists them", name));
  }
  return *model;
}

/// Fetches into `stream`; gives the SHA-256 of what came.
std::string FetchAndHash(const std::string& address, const ModelsArguments& arguments,
                         std::ostream& stream) {
  const InterruptStop interrupt;
  Sha256 hash;
  DownloadBar bar;
  Download download;
  download.address = address;
  download.stop = interrupt.token();
  download.take = [&](std::span<const char> bytes) {
    hash.Add(bytes);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!stream) throw Error("the disk is full or the folder cannot be written");
  };
  if (!arguments.quiet) {
    download.progress = [&](std::uint64_t done, std::uint64_t total) { bar.OnBytes(done, total); };
  }
  try {
    Fetch(download);
  } catch (const Error& error) {
    throw Error(
        fmt::format("{}; without a connection, fetch it elsewhere, copy it to {} and run "
                    "ofm-slam models verify",
                    error.what(), (arguments.to / ModelOf(arguments.name).file).string()));
  }
  return hash.Finish();
}

void DownloadModel(const ModelsArguments& arguments) {
  const KnownModel& model = ModelOf(arguments.name);
  if (!model.make.empty() && arguments.from.empty()) {
    throw Error(fmt::format("{} is not published as a file; make it from {}: {}", model.name,
                            model.address, model.make));
  }
  const std::filesystem::path path = arguments.to / model.file;
  const std::string wanted =
      arguments.sha256.empty() ? std::string(model.sha256) : ParseSha256(arguments.sha256);
  if (!wanted.empty() && std::filesystem::is_regular_file(path) && Sha256OfFile(path) == wanted) {
    fmt::print("{} is there already and verified\n", path.string());
    return;
  }
  std::error_code failed;
  std::filesystem::create_directories(arguments.to, failed);
  if (failed) throw Error(arguments.to, "the folder cannot be made: " + failed.message());
  const std::string address = arguments.from.empty() ? std::string(model.address) : arguments.from;
  fmt::print("{} ({}, licence: {})\nfrom {}\n", model.name, SizeOf(model), model.licence, address);
  std::fflush(stdout);
  std::string sha256;
  WriteFileAtomically(path, [&](std::ostream& stream) {
    sha256 = FetchAndHash(address, arguments, stream);
    if (!wanted.empty() && sha256 != wanted) {
      throw Error(path, fmt::format("what came has the SHA-256 {}, not {}; it was thrown away",
                                    sha256, wanted));
    }
  });
  fmt::print("{}  {}\n{}\nuse: {}\n", sha256, path.string(),
             wanted.empty() ? "not verified: nobody publishes its SHA-256; pin it with --sha256"
                            : "verified",
             model.use);
}

void VerifyModel(const ModelsArguments& arguments) {
  const std::string sha256 = Sha256OfFile(arguments.file);
  if (!arguments.sha256.empty()) {
    const std::string wanted = ParseSha256(arguments.sha256);
    if (sha256 != wanted) {
      throw Error(arguments.file, fmt::format("has the SHA-256 {}, not {}", sha256, wanted));
    }
    fmt::print("{}  {}\nverified\n", sha256, arguments.file.string());
    return;
  }
  if (const KnownModel* model = FindModelBySha256(sha256)) {
    fmt::print("{}  {}\nverified: {} (licence: {})\nuse: {}\n", sha256, arguments.file.string(),
               model->name, model->licence, model->use);
    return;
  }
  const KnownModel* named = FindModelByFile(arguments.file.filename().string());
  if (named != nullptr && !named->sha256.empty()) {
    throw Error(arguments.file,
                fmt::format("is not {} or did not arrive whole: its SHA-256 is {}, not {}",
                            named->name, sha256, named->sha256));
  }
  throw Error(arguments.file, fmt::format("is none of the known models: its SHA-256 is {}; compare "
                                          "it with --sha256",
                                          sha256));
}

}  // namespace

void AddModelsCommand(CLI::App& app) {
  auto arguments = std::make_shared<ModelsArguments>();
  CLI::App* command =
      app.add_subcommand("models", "List the networks for --segmenter, download and verify them");
  command->footer(kFooter);
  command->require_subcommand(0, 1);
  command->add_subcommand("list", "Print the known models (as without a subcommand)");

  CLI::App* download = command->add_subcommand("download", "Download a model and verify it");
  download->add_option("NAME", arguments->name, "As the list calls it")->required();
  download->add_option("--to", arguments->to, "Folder for the file")->capture_default_str();
  download->add_option("--from", arguments->from, "Another address of the same file (a mirror)");
  download->add_option("--sha256", arguments->sha256, "What the file's SHA-256 must be");
  download->add_flag("--quiet", arguments->quiet, "No progress bar");

  CLI::App* verify = command->add_subcommand("verify", "Tell whether a file is a known model");
  verify->add_option("FILE", arguments->file, "Path of the file")->required();
  verify->add_option("--sha256", arguments->sha256, "What the file's SHA-256 must be");

  command->callback([arguments, download, verify] {
    if (download->parsed()) {
      DownloadModel(*arguments);
    } else if (verify->parsed()) {
      VerifyModel(*arguments);
    } else {
      ListModels();
    }
  });
}

}  // namespace ofm
