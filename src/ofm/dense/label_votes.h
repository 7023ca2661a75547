// Fusion of labels in one voxel.
#pragma once

#include <array>
#include <cstdint>

#include "ofm/dense/labelled_frame.h"

namespace ofm {

/// Confidence-weighted votes for the three strongest classes. "No label" (kNoLabel) is a candidate
/// like any other. Where a fourth class comes, its vote weakens the weakest class and replaces it
/// once that is used up (as in the "frequent" algorithm of Misra and Gries, 1982), so a class that
/// gets more than a quarter of the weight is always held.
class LabelVotes {
 public:
  /// `confidence` of this observation: 255 = sure, 0 changes nothing but the mean.
  void Add(std::uint8_t class_id, std::uint8_t confidence);

  /// The class with most weight; of equals the one that came first. kNoLabel without votes.
  std::uint8_t Best() const { return class_ids_[BestSlot()]; }
  /// Mean over all observations of the confidence they gave to Best(); 0 without votes.
  std::uint8_t Confidence() const;

 private:
  static constexpr int kSlots = 3;
  int BestSlot() const;

  std::array<std::uint8_t, kSlots> class_ids_{kNoLabel, kNoLabel, kNoLabel};
  std::array<float, kSlots> weights_{};
  float observations_ = 0;
};

}  // namespace ofm
