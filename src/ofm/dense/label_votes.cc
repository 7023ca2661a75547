#include "ofm/dense/label_votes.h"

#include <algorithm>
#include <cmath>

namespace ofm {

void LabelVotes::Add(std::uint8_t class_id, std::uint8_t confidence) {
  observations_ += 1;
  const auto weight = static_cast<float>(confidence);
  int weakest = 0;
  for (int slot = 0; slot < kSlots; ++slot) {
    if (weights_[slot] > 0 && class_ids_[slot] == class_id) {
      weights_[slot] += weight;
      return;
    }
    if (weights_[slot] < weights_[weakest]) weakest = slot;
  }
  if (weights_[weakest] >= weight) {
    weights_[weakest] -= weight;
  } else {
    weights_[weakest] = weight - weights_[weakest];
    class_ids_[weakest] = class_id;
  }
}

int LabelVotes::BestSlot() const {
  return static_cast<int>(std::max_element(weights_.begin(), weights_.end()) - weights_.begin());
}

std::uint8_t LabelVotes::Confidence() const {
  if (observations_ == 0) return 0;
  return static_cast<std::uint8_t>(std::lround(weights_[BestSlot()] / observations_));
}

}  // namespace ofm
