#include "ofm/dense/label_belief.h"

#include <cmath>

namespace ofm {
namespace {

constexpr int kClasses = 81;  // COCO's and "none"; with other numbers evidence changes little

float Evidence(double probability) {
  const double p = std::min(probability, .99);
  return static_cast<float>(std::max(0., std::log(p * (kClasses - 1) / (1 - p))));
}

}  // namespace

PointEvidence::PointEvidence(double resolution_m, double share)
    : half_voxel_squared_m2_(static_cast<float>(resolution_m * resolution_m / 4)) {
  for (std::size_t confidence = 0; confidence < by_confidence_.size(); ++confidence) {
    by_confidence_[confidence] =
        static_cast<float>(share) * Evidence(static_cast<double>(confidence) / 255);
  }
}

void LabelBelief::Add(std::uint8_t class_id, float evidence) {
  if (!(evidence > 0)) return;
  int weakest = 0;
  for (int slot = 0; slot < kSlots; ++slot) {
    if (class_ids_[slot] == class_id && log_weights_[slot] != kFree) {
      log_weights_[slot] += evidence;
      return Clamp(slot);
    }
    if (log_weights_[slot] < log_weights_[weakest]) weakest = slot;
  }
  float loser = log_rest_ + evidence;  // until now it was one of the rest
  if (loser > log_weights_[weakest]) {
    std::swap(loser, log_weights_[weakest]);
    class_ids_[weakest] = class_id;
  }
  if (loser != kFree) AddToRest(loser);
  Clamp(weakest);
}

/// One of the classes without a slot has this weight, and not the mean of the others.
void LabelBelief::AddToRest(float log_weight) {
  constexpr float kRest = kClasses - kSlots;
  log_rest_ += std::log((kRest - 1 + std::exp(log_weight - log_rest_)) / kRest);
}

void LabelBelief::Clamp(int slot) {
  const float excess = log_weights_[slot] - kMaxLogOdds;
  if (excess <= 0) return;
  for (float& weight : log_weights_) {
    if (weight != kFree) weight = std::max(0.F, weight - excess);
  }
  log_rest_ = std::max(0.F, log_rest_ - excess);
  log_weights_[slot] = kMaxLogOdds;
}

int LabelBelief::BestSlot() const {
  return static_cast<int>(std::max_element(log_weights_.begin(), log_weights_.end()) -
                          log_weights_.begin());
}

std::uint8_t LabelBelief::Confidence() const {
  const float best = log_weights_[BestSlot()];
  if (best == kFree) return 0;
  int rest = kClasses;
  float sum = 0;
  for (const float weight : log_weights_) {
    if (weight == kFree) continue;
    sum += std::exp(weight - best);
    --rest;
  }
  sum += static_cast<float>(rest) * std::exp(log_rest_ - best);
  return static_cast<std::uint8_t>(std::lround(255 / sum));
}

}  // namespace ofm
