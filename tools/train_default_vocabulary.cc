// Makes the vocabulary that comes with the program from images of simulated rooms, with nothing
// recorded in them; the same build on the same machine gives the same bytes:
//   build/release/bin/ofm_train_default_vocabulary src/ofm/features/default_vocabulary.bin
//
// Every room is painted anew, coarser and finer, with more and less contrast, and is seen with the
// noise, exposure and blur of a camera held in the hand: the words that plain surfaces and blur
// give must be known as common ones. 16^3 words told real places apart better than 10^4 or 10^5.
#include <fmt/core.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <numbers>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "ofm/base/error.h"
#include "ofm/base/random.h"
#include "ofm/features/orb_extractor.h"
#include "ofm/features/vocabulary_file.h"
#include "ofm/features/vocabulary_training.h"
#include "ofm/sim/sim_sequence.h"

namespace ofm {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr int kRooms = 150;
constexpr int kViewsPerRoom = 8;

double Uniform(RandomEngine& engine, double low, double high) {
  return low + (high - low) * UniformReal(engine);
}

/// Half of the surfaces are nearly plain, as in most rooms: their features are edges and noise.
TextureOptions RandomTexture(RandomEngine& engine) {
  TextureOptions texture;
  const double kind = UniformReal(engine);
  texture.style = kind < 0.7   ? TextureStyle::kPatches
                  : kind < 0.9 ? TextureStyle::kNoise
                               : TextureStyle::kChecker;
  texture.metres_per_texel = 1e-3 * std::exp(Uniform(engine, 0, std::log(10.0)));
  texture.contrast =
      UniformIndex(engine, 2) == 0 ? Uniform(engine, 0.02, 0.15) : Uniform(engine, 0.2, 1);
  return texture;
}

/// The room with every texture replaced by another.
Scene PaintAnew(const Scene& room, RandomEngine& engine) {
  std::map<const Texture*, std::size_t> numbers;  // in the order of the parts, not of the addresses
  std::vector<std::shared_ptr<const Texture>> textures;
  std::vector<Body> bodies = room.bodies();
  for (Body& body : bodies) {
    for (Part& part : body.parts) {
      const auto [found, is_new] = numbers.emplace(part.texture.get(), textures.size());
      if (is_new) {
        const TextureOptions options = RandomTexture(engine);
        textures.push_back(std::make_shared<const Texture>(options, engine()));
      }
      part.texture = textures[found->second];
    }
  }
  return {std::move(bodies), room.viewpoint()};
}

SimSequence MakeRandomRoom(std::uint64_t seed, RandomEngine& engine) {
  constexpr CameraPathKind kPaths[] = {CameraPathKind::kTour, CameraPathKind::kHalfsphere,
                                       CameraPathKind::kXyz, CameraPathKind::kRpy};
  SimSequenceOptions options;
  options.seed = seed;
  options.frames = kViewsPerRoom;
  options.camera = MakeSimCamera(640, 480);
  options.path.kind = kPaths[seed % 4];
  options.path.period_s = 6;
  options.rate_hz = kViewsPerRoom / 24.0;  // over a whole tour
  options.room.width_m = Uniform(engine, 4, 8);
  options.room.depth_m = Uniform(engine, 4, 7);
  options.room.people = static_cast<int>(UniformIndex(engine, 3));
  options.noise.model = NoiseModel::kKinect;
  options.noise.image_sigma = Uniform(engine, 1, 4);
  return {options, PaintAnew(MakeRoom(options.room, seed), engine)};
}

/// Over- or underexposed, and blurred by a shake or out of focus, as every other frame of a camera
/// held in the hand.
cv::Mat SeenByACamera(const cv::Mat& gray, RandomEngine& engine) {
  cv::Mat seen;
  gray.convertTo(seen, CV_8U, Uniform(engine, 0.6, 1.8), Uniform(engine, -30, 30));
  if (UniformIndex(engine, 2) == 0) return seen;
  const int length_px = 3 + static_cast<int>(UniformIndex(engine, 23));
  const double angle_rad = Uniform(engine, 0, std::numbers::pi);
  const cv::Point2d half = 0.5 * length_px * cv::Point2d(std::cos(angle_rad), std::sin(angle_rad));
  const int size = length_px | 1;
  const cv::Point2d centre(size / 2, size / 2);
  cv::Mat kernel(size, size, CV_32FC1, cv::Scalar(0));
  cv::line(kernel, centre - half, centre + half, cv::Scalar(1));
  kernel /= cv::sum(kernel)[0];
  cv::filter2D(seen, seen, -1, kernel);
  cv::GaussianBlur(seen, seen, {}, Uniform(engine, 0.3, 1.2));
  return seen;
}

std::vector<std::vector<Descriptor>> DescribeRooms() {
  OrbExtractor extractor{OrbOptions()};
  std::vector<std::vector<Descriptor>> images;
  for (std::uint64_t room = 1; room <= kRooms; ++room) {
    RandomEngine engine = MakeRandomEngine(kSeed, room);
    SimSequence sequence = MakeRandomRoom(room, engine);
    while (const auto frame = sequence.Next()) {
      images.push_back(extractor.Extract(SeenByACamera(frame->gray, engine)).descriptors);
    }
    fmt::print(stderr, "\rroom {} of {}", room, kRooms);
  }
  fmt::print(stderr, "\n");
  return images;
}

int Main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "give the path of the file to write\n");
    return 1;
  }
  cv::setNumThreads(1);
  try {
    const auto vocabulary =
        TrainVocabulary(DescribeRooms(), {.branching = 16, .depth = 3}, MakeRandomEngine(kSeed, 0));
    SaveVocabulary(argv[1], *vocabulary);
    fmt::print("{} words\n", vocabulary->word_count());
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace ofm

int main(int argc, char** argv) { return ofm::Main(argc, argv); }
