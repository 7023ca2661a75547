// Bayesian fusion of labels in one voxel.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "ofm/dense/labelled_point.h"

namespace ofm {

/// Evidence of labelled points for their classes, in voxels of one size. A network that is right
/// with probability p, and else names any other of N classes (COCO's 80 and "none") alike, raises
/// the log-odds of the class that it names against each other one by log(p (N - 1) / (1 - p)): 0
/// where p is no better than chance, and p is at most 0.99. A point whose depth is so uncertain
/// that it may belong to another voxel counts less: (half a voxel / its standard deviation)^2, at
/// most 1.
class PointEvidence {
 public:
  /// Each point counts as `share` of an observation; points of one view are not independent.
  explicit PointEvidence(double resolution_m, double share = 1);

  float operator()(const LabelledPoint& point) const {
    return by_confidence_[point.confidence] *
           std::min(1.F, point.precision * half_voxel_squared_m2_);
  }

 private:
  std::array<float, 256> by_confidence_;
  float half_voxel_squared_m2_;
};

/// What is believed of a voxel's class: Bayes' rule with the likelihood above, over all classes, of
/// which the four likeliest are held one by one and the others as equals (after Asgharivaskasi and
/// Atanasov, "Semantic octree mapping and Shannon mutual information computation for robot
/// exploration", IEEE T-RO 2023). "No label" (kNoLabel) is a class like any other. As occupancies
/// are, beliefs are clamped, so that what was long believed can still change.
class LabelBelief {
 public:
  /// Multiplies the odds of `class_id` against every other class by exp(`evidence`), at least 0.
  void Add(std::uint8_t class_id, float evidence);

  /// The likeliest class; of equals the one that came first. kNoLabel without observations.
  std::uint8_t Best() const { return class_ids_[BestSlot()]; }
  /// Probability of Best(), 255 = sure; 0 without observations.
  std::uint8_t Confidence() const;

 private:
  static constexpr int kSlots = 4;
  static constexpr float kFree = -1;
  /// What a class can be ahead of one never seen: three observations of a network that is sure.
  static constexpr float kMaxLogOdds = 20;

  int BestSlot() const;
  void AddToRest(float log_weight);
  void Clamp(int slot);

  std::array<std::uint8_t, kSlots> class_ids_{kNoLabel, kNoLabel, kNoLabel, kNoLabel};
  // Logarithms of probabilities but for a common factor, from 0 to kMaxLogOdds, or kFree.
  std::array<float, kSlots> log_weights_{kFree, kFree, kFree, kFree};
  float log_rest_ = 0;  // mean of the classes that have no slot
};

}  // namespace ofm
