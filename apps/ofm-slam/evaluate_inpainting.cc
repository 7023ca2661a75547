// ofm-slam evaluate-inpainting: how much of what people hid was filled, and how well.
#include <fmt/format.h>

#include <map>
#include <memory>
#include <string>

#include "commands.h"
#include "ofm/base/error.h"
#include "ofm/dense/inpainting_metrics.h"
#include "ofm/io/camera_file.h"
#include "ofm/io/image_file.h"
#include "ofm/io/tum_sequence.h"

namespace ofm {
namespace {

constexpr const char* kFooter =
    "MASKS holds PNGs of true instance ids (0 = static) and STATIC the same frames without "
    "actors,\n"
    "as made scenarios have them; frames belong together by their names. Prints which share of "
    "the\n"
    "actors' pixels has a depth in the filled frames, the median error of these depths, and the\n"
    "PSNR of these colours.\n"
    "Example:\n"
    "  ofm-slam run desk_walking --segmenter masks --write-inpainted filled\n"
    "  ofm-slam evaluate-inpainting filled desk_walking/mask tum_fr1_desk";

struct InpaintingArguments {
  std::filesystem::path inpainted, masks, truth;
};

std::string NameOf(const TumEntry& entry) { return entry.color.path.stem().string(); }

InpaintingMetrics Measure(const InpaintingArguments& arguments) {
  const PinholeCamera camera = LoadCamera(arguments.inpainted / "camera.yaml");
  const RgbdSequence inpainted(arguments.inpainted, camera), truth(arguments.truth, camera);
  std::map<std::string, std::size_t> true_index;
  for (std::size_t i = 0; i < truth.size(); ++i) true_index[NameOf(truth.entries()[i])] = i;
  InpaintingMeter meter;
  for (std::size_t i = 0; i < inpainted.size(); ++i) {
    const auto found = true_index.find(NameOf(inpainted.entries()[i]));
    if (found == true_index.end()) {
      throw Error(arguments.truth, "has no frame " + NameOf(inpainted.entries()[i]));
    }
    const RgbdFrame frame = inpainted.Load(i), expected = truth.Load(found->second);
    const cv::Mat actors =
        LoadMaskImage(arguments.masks / (frame.name + ".png"), frame.color.size());
    meter.AddFrame(frame.color, frame.depth_m, actors, expected.color, expected.depth_m);
  }
  return meter.metrics();
}

void EvaluateInpainting(const InpaintingArguments& arguments) {
  const InpaintingMetrics metrics = Measure(arguments);
  fmt::print("filled   {} of {} pixels that actors hid ({:.1f} %)\n", metrics.filled_pixels,
             metrics.hidden_pixels, 100 * metrics.filled_share);
  fmt::print("depth    median error {:.1f} mm\n", 1e3 * metrics.median_depth_error_m);
  fmt::print("colour   PSNR {:.1f} dB\n", metrics.psnr_db);
}

}  // namespace

void AddEvaluateInpaintingCommand(CLI::App& app) {
  auto arguments = std::make_shared<InpaintingArguments>();
  CLI::App* command = app.add_subcommand(
      "evaluate-inpainting", "Print how much of what actors hid was filled, and how well");
  command->footer(kFooter);
  command->add_option("INPAINTED", arguments->inpainted, "Folder of ofm-slam run --write-inpainted")
      ->required();
  command->add_option("MASKS", arguments->masks, "Folder of true instance masks (PNG)")->required();
  command->add_option("STATIC", arguments->truth, "TUM RGB-D folder of the frames without actors")
      ->required();
  command->callback([arguments] { EvaluateInpainting(*arguments); });
}

}  // namespace ofm
