// How well the words of images tell places: recall and precision on a sequence with ground truth.
#pragma once

#include <cstdint>
#include <vector>

#include "ofm/features/vocabulary.h"
#include "rgbd_samples.h"

namespace ofm {

/// What is needed of a frame.
struct PlaceView {
  std::int64_t stamp_ns = 0;
  RigidTransform world_from_camera;
  cv::Mat depth_m;
  Features features;
};

/// Every `step`-th frame, with the default features.
std::vector<PlaceView> ReadViews(const RgbdSampleSource& source, int step);

/// The smaller of two shares: of the points that `a` measured, those that `b` sees, and the other
/// way round. A point is seen where it falls into the image and is not behind what is measured
/// there.
double ViewOverlap(const PinholeCamera& camera, const PlaceView& a, const PlaceView& b);

/// All pairs of views; ViewOverlap of i and j is at [i][j].
std::vector<std::vector<double>> ViewOverlaps(const PinholeCamera& camera,
                                              const std::vector<PlaceView>& views);

struct PlaceCriteria {
  double min_gap_s = 3;         ///< views nearer in time are not asked for
  double overlap_right = 0.5;   ///< a view with such a one is to be recognised
  double overlap_wrong = 0.25;  ///< an answer with less is wrong
};

/// Of queries, one a view, whose answer is the most similar view; answers count from a threshold of
/// the similarity upwards.
struct PlaceQuality {
  int queries = 0;      ///< in all
  int expected = 0;     ///< whose place was seen at another time
  int first_right = 0;  ///< of `expected`, those whose answer is right, however similar
  double recall_at_full_precision = 0, recall_at_95_precision = 0;  ///< the best of all thresholds
  double threshold_at_full_precision = 0, threshold_at_95_precision = 0;
};

PlaceQuality MeasurePlaces(const Vocabulary& vocabulary, const std::vector<PlaceView>& views,
                           const std::vector<std::vector<double>>& overlaps,
                           const PlaceCriteria& criteria);

}  // namespace ofm
