#include "place_quality.h"

#include <algorithm>
#include <cmath>

#include "ofm/features/orb_extractor.h"
#include "ofm/features/place_database.h"

namespace ofm {
namespace {

constexpr int kGridStep_px = 16;

/// Share of the points of `a` that `b` sees.
double SharedPart(const PinholeCamera& camera, const PlaceView& a, const PlaceView& b) {
  const RigidTransform b_from_a = b.world_from_camera.Inverse() * a.world_from_camera;
  int measured = 0, seen = 0;
  for (int y = kGridStep_px / 2; y < camera.height; y += kGridStep_px) {
    for (int x = kGridStep_px / 2; x < camera.width; x += kGridStep_px) {
      const double depth_m = a.depth_m.at<float>(y, x);
      if (depth_m <= 0) continue;
      ++measured;
      // The lens moves a pixel by less than matters here.
      const Eigen::Vector3d in_b = b_from_a * camera.UnprojectIdeal({x, y}, depth_m);
      if (in_b.z() < 0.1) continue;
      const Eigen::Vector2d pixel = camera.ProjectIdeal(in_b);
      if (!camera.IsInImage(pixel)) continue;
      const double there_m = b.depth_m.at<float>(static_cast<int>(std::lround(pixel.y())),
                                                 static_cast<int>(std::lround(pixel.x())));
      if (there_m <= 0 || in_b.z() < 1.1 * there_m) ++seen;
    }
  }
  return measured > 0 ? static_cast<double>(seen) / measured : 0;
}

/// The best answer to one query.
struct Answer {
  double similarity;
  bool is_right;
};

struct Recall {
  double share = 0, threshold = 0;
};

/// Highest recall of all thresholds at which the answers have the precision.
Recall BestRecall(std::vector<Answer> answers, int expected, double min_precision) {
  std::ranges::stable_sort(answers, std::greater<>(), &Answer::similarity);
  Recall best;
  int given = 0, right = 0;
  for (const Answer& answer : answers) {
    ++given;
    right += answer.is_right;
    const double share = static_cast<double>(right) / expected;
    if (right >= min_precision * given && share > best.share) best = {share, answer.similarity};
  }
  return best;
}

class PlaceMeter {
 public:
  PlaceMeter(const Vocabulary& vocabulary, const std::vector<PlaceView>& views,
             const PlaceCriteria& criteria)
      : views_(views), criteria_(criteria) {
    for (std::uint32_t i = 0; i < views.size(); ++i) {
      words_.push_back(vocabulary.Describe(views[i].features.descriptors).words);
      database_.Add(KeyframeId(i), words_.back());
    }
  }

  PlaceQuality Measure(const std::vector<std::vector<double>>& overlaps) const {
    PlaceQuality quality;
    std::vector<Answer> answers;
    for (std::uint32_t i = 1; i < views_.size(); ++i) {
      ++quality.queries;
      const bool is_expected = Expects(i, overlaps[i]);
      quality.expected += is_expected;
      const auto found = database_.Query(words_[i], {.max_count = 1, .excluded = Near(i)});
      if (found.empty()) continue;
      const double overlap = overlaps[i][found[0].keyframe.value];
      const bool is_right = overlap >= criteria_.overlap_wrong;
      quality.first_right += is_expected && is_right;
      // An answer of some overlap to a view that need not be recognised counts neither way.
      if (is_right && !is_expected) continue;
      answers.push_back({found[0].similarity, is_right});
    }
    const Recall full = BestRecall(answers, quality.expected, 1);
    const Recall most = BestRecall(answers, quality.expected, 0.95);
    quality.recall_at_full_precision = full.share;
    quality.threshold_at_full_precision = full.threshold;
    quality.recall_at_95_precision = most.share;
    quality.threshold_at_95_precision = most.threshold;
    return quality;
  }

 private:
  bool IsNear(std::uint32_t i, std::uint32_t j) const {
    const double gap_s = 1e-9 * static_cast<double>(views_[i].stamp_ns - views_[j].stamp_ns);
    return std::abs(gap_s) < criteria_.min_gap_s;
  }
  std::set<KeyframeId> Near(std::uint32_t i) const {
    std::set<KeyframeId> near;
    for (std::uint32_t j = 0; j < views_.size(); ++j) {
      if (IsNear(i, j)) near.insert(KeyframeId(j));
    }
    return near;
  }
  bool Expects(std::uint32_t i, const std::vector<double>& overlaps) const {
    for (std::uint32_t j = 0; j < views_.size(); ++j) {
      if (!IsNear(i, j) && overlaps[j] >= criteria_.overlap_right) return true;
    }
    return false;
  }

  const std::vector<PlaceView>& views_;
  PlaceCriteria criteria_;
  std::vector<BagOfWords> words_;
  PlaceDatabase database_;
};

}  // namespace

std::vector<PlaceView> ReadViews(const RgbdSampleSource& source, int step) {
  OrbExtractor extractor{OrbOptions()};
  std::vector<PlaceView> views;
  for (int i = 0; i < source.size(); i += step) {
    const RgbdSample sample = source.Read(i);
    views.push_back({sample.stamp_ns, sample.world_from_camera, sample.depth_m,
                     extractor.Extract(sample.gray)});
  }
  return views;
}

double ViewOverlap(const PinholeCamera& camera, const PlaceView& a, const PlaceView& b) {
  return std::min(SharedPart(camera, a, b), SharedPart(camera, b, a));
}

std::vector<std::vector<double>> ViewOverlaps(const PinholeCamera& camera,
                                              const std::vector<PlaceView>& views) {
  std::vector<std::vector<double>> overlaps(views.size(), std::vector<double>(views.size(), 1));
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      overlaps[i][j] = overlaps[j][i] = ViewOverlap(camera, views[i], views[j]);
    }
  }
  return overlaps;
}

PlaceQuality MeasurePlaces(const Vocabulary& vocabulary, const std::vector<PlaceView>& views,
                           const std::vector<std::vector<double>>& overlaps,
                           const PlaceCriteria& criteria) {
  return PlaceMeter(vocabulary, views, criteria).Measure(overlaps);
}

}  // namespace ofm
