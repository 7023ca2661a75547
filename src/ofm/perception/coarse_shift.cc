#include "ofm/perception/coarse_shift.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <opencv2/core.hpp>
#include <vector>

#include "ofm/base/check.h"

namespace ofm {
namespace {

/// Of an object of depth 1 in the second frame this is still the same place.
constexpr float kSameDepth_m = 0.25F;

/// The coarsest level of a frame with its depths.
struct CoarseImage {
  CoarseImage(const FlowFrame& frame, int level)
      : gray(frame.pyramid.levels[2 * static_cast<std::size_t>(level)]),
        depth_m(gray.size(), CV_32FC1) {
    const int scale = 1 << level;
    for (int y = 0; y < gray.rows; ++y) {
      const auto* row = frame.depth_m.ptr<float>(std::min(y * scale, frame.depth_m.rows - 1));
      auto* to = depth_m.ptr<float>(y);
      for (int x = 0; x < gray.cols; ++x) to[x] = row[std::min(x * scale, frame.depth_m.cols - 1)];
    }
  }

  cv::Mat gray, depth_m;
};

struct Sample {
  int x, y, gray;
  float depth_m;
};

/// Pixels of the object, and of what surrounds it at another depth, with the object's depth there.
struct Samples {
  std::vector<Sample> object, surroundings;
};

/// Keeps about `most`, evenly.
void Thin(std::size_t most, std::vector<Sample>& samples) {
  const std::size_t step = samples.size() / most + 1;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < samples.size(); i += step) samples[kept++] = samples[i];
  samples.resize(kept);
}

Samples TakeSamples(const Instance& instance, const CoarseImage& image, int scale) {
  const cv::Size size = image.gray.size();
  const auto is_object = [&](int x, int y) {
    return instance.mask.at<std::uint8_t>(std::min(y * scale, instance.mask.rows - 1),
                                          std::min(x * scale, instance.mask.cols - 1)) != 0;
  };
  constexpr int kRing = 2;
  const int left = std::max(0, instance.box.x / scale - kRing);
  const int top = std::max(0, instance.box.y / scale - kRing);
  const int right = std::min(size.width, instance.box.br().x / scale + kRing + 1);
  const int bottom = std::min(size.height, instance.box.br().y / scale + kRing + 1);
  Samples samples;
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      const float depth_m = image.depth_m.at<float>(y, x);
      if (is_object(x, y)) {
        samples.object.push_back({x, y, image.gray.at<std::uint8_t>(y, x), depth_m});
        continue;
      }
      const int offsets[4][2] = {{-kRing, 0}, {kRing, 0}, {0, -kRing}, {0, kRing}};
      for (const auto& [dx, dy] : offsets) {
        const int u = x + dx, v = y + dy;
        if (u < 0 || v < 0 || u >= size.width || v >= size.height || !is_object(u, v)) continue;
        const float object_m = image.depth_m.at<float>(v, u);
        if (object_m > 0 && std::abs(depth_m - object_m) > 2 * kSameDepth_m) {
          samples.surroundings.push_back({x, y, 0, object_m});
          break;
        }
      }
    }
  }
  constexpr std::size_t kMostOfObject = 300, kMostAround = 150;
  Thin(kMostOfObject, samples.object);
  Thin(kMostAround, samples.surroundings);
  return samples;
}

/// How badly the samples fit `image` when shifted.
struct Misfit {
  double cost = std::numeric_limits<double>::infinity();
  double agreement = 0;
};

class Matcher {
 public:
  Matcher(const Samples& samples, const CoarseImage& image) : samples_(samples), image_(image) {}

  Misfit At(int dx, int dy) const {
    constexpr int kMostGray = 50;
    int inside = 0, gray = 0, measured = 0, agree = 0;
    for (const Sample& sample : samples_.object) {
      const int x = sample.x + dx, y = sample.y + dy;
      if (IsOutside(x, y)) continue;
      ++inside;
      gray += std::min(kMostGray, std::abs(sample.gray - image_.gray.ptr<std::uint8_t>(y)[x]));
      const float depth_m = image_.depth_m.ptr<float>(y)[x];
      if (depth_m == 0 || sample.depth_m == 0) continue;
      ++measured;
      agree += std::abs(depth_m - sample.depth_m) < kSameDepth_m ? 1 : 0;
    }
    if (inside * 4 < static_cast<int>(samples_.object.size())) return {};
    int around = 0, wrong = 0;
    for (const Sample& sample : samples_.surroundings) {
      const int x = sample.x + dx, y = sample.y + dy;
      if (IsOutside(x, y)) continue;
      ++around;
      wrong += std::abs(image_.depth_m.ptr<float>(y)[x] - sample.depth_m) < kSameDepth_m ? 1 : 0;
    }
    const auto share = [](int part, int of) { return of > 0 ? static_cast<double>(part) / of : 0; };
    Misfit misfit;
    misfit.agreement = share(agree, measured);
    misfit.cost =
        share(gray, inside * kMostGray) + share(measured - agree, measured) + share(wrong, around);
    return misfit;
  }

 private:
  bool IsOutside(int x, int y) const {
    return static_cast<unsigned>(x) >= static_cast<unsigned>(image_.gray.cols) ||
           static_cast<unsigned>(y) >= static_cast<unsigned>(image_.gray.rows);
  }

  const Samples& samples_;
  const CoarseImage& image_;
};

/// Places around a centre [pixels of the level].
struct Places {
  cv::Point centre;
  int radius, step;
  cv::Point expected;
  int reach;
};

struct Place {
  cv::Point shift;
  Misfit misfit;
};

Place FindBest(const Matcher& matcher, const Places& places) {
  // What is farther from the expected place must fit better: on plain objects many places do.
  constexpr double kCostOfReach = 0.1;
  Place best{places.expected, {}};
  for (int y = -places.radius; y <= places.radius; y += places.step) {
    for (int x = -places.radius; x <= places.radius; x += places.step) {
      const cv::Point shift = places.centre + cv::Point(x, y);
      Misfit misfit = matcher.At(shift.x, shift.y);
      const cv::Point away = shift - places.expected;
      misfit.cost += kCostOfReach * std::hypot(away.x, away.y) / std::max(1, places.reach);
      if (misfit.cost < best.misfit.cost) best = {shift, misfit};
    }
  }
  return best;
}

}  // namespace

CoarseShift FindCoarseShift(const Instance& instance, const FlowFrame& from, const FlowFrame& to,
                            const CoarseSearch& search) {
  OFM_CHECK(from.pyramid.size == to.pyramid.size && from.pyramid.levels.size() >= 2);
  OFM_CHECK(from.pyramid.levels.size() == to.pyramid.levels.size());
  const int level = static_cast<int>(from.pyramid.levels.size()) / 2 - 1, scale = 1 << level;
  const CoarseImage before(from, level), now(to, level);
  const Samples samples = TakeSamples(instance, before, scale);
  const Matcher matcher(samples, now);
  const cv::Point expected(static_cast<int>(std::lround(search.expected_px.x() / scale)),
                           static_cast<int>(std::lround(search.expected_px.y() / scale)));
  const int reach = search.reach_px / scale;
  // Every other place first, then those around the best.
  Place best = FindBest(matcher, {expected, reach, 2, expected, reach});
  best = FindBest(matcher, {best.shift, 1, 1, expected, reach});
  const cv::Point2f shift_px = cv::Point2f(best.shift) * static_cast<float>(scale);
  return {{shift_px.x, shift_px.y}, best.misfit.agreement};
}

}  // namespace ofm
