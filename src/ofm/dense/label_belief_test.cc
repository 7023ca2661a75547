#include "ofm/dense/label_belief.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ofm/base/random.h"

namespace ofm {
namespace {

LabelledPoint Point(std::uint8_t confidence, double sigma_m = .001) {
  LabelledPoint point;
  point.confidence = confidence;
  point.precision = static_cast<float>(1 / (sigma_m * sigma_m));
  return point;
}

TEST(PointEvidence, IsTheLogarithmOfTheOddsAgainstEachOtherClass) {
  const PointEvidence evidence(.05);
  EXPECT_NEAR(evidence(Point(204)), std::log(.8 * 80 / .2), 1e-5);
  EXPECT_EQ(evidence(Point(0)), 0);
  EXPECT_EQ(evidence(Point(3)), 0);  // no better than chance
  EXPECT_NEAR(evidence(Point(255)), std::log(.99 * 80 / .01), 1e-4);
  EXPECT_NEAR(PointEvidence(.05, .25)(Point(204)), std::log(.8 * 80 / .2) / 4, 1e-5);
}

TEST(PointEvidence, DepthThatMayBeAnotherVoxelsCountsLess) {
  const PointEvidence evidence(.02);
  const float sure = evidence(Point(204, .001));
  EXPECT_EQ(evidence(Point(204, .01)), sure);
  EXPECT_NEAR(evidence(Point(204, .02)), sure / 4, 1e-5);
  EXPECT_EQ(PointEvidence(.05)(Point(204, .02)), sure);
}

TEST(LabelBelief, NothingIsKnownWithoutObservations) {
  LabelBelief belief;
  EXPECT_EQ(belief.Best(), kNoLabel);
  EXPECT_EQ(belief.Confidence(), 0);
  belief.Add(7, 0);
  EXPECT_EQ(belief.Best(), kNoLabel);
}

TEST(LabelBelief, OneObservationIsAsSureAsTheNetwork) {
  for (const std::uint8_t confidence : {30, 128, 204, 250}) {
    LabelBelief belief;
    belief.Add(7, PointEvidence(.05)(Point(confidence)));
    EXPECT_EQ(belief.Best(), 7);
    EXPECT_EQ(belief.Confidence(), confidence);
  }
}

TEST(LabelBelief, ProbabilitiesMultiply) {
  const auto evidence = [](double p) { return static_cast<float>(std::log(p * 80 / (1 - p))); };
  LabelBelief belief;
  belief.Add(3, evidence(.4));
  belief.Add(9, evidence(.6));
  belief.Add(3, evidence(.5));
  // By hand: weights relative to a class that was never named.
  const double w3 = .4 * 80 / .6 * (.5 * 80 / .5), w9 = .6 * 80 / .4;
  EXPECT_EQ(belief.Best(), 3);
  EXPECT_EQ(belief.Confidence(), std::lround(255 * w3 / (w3 + w9 + 79)));
}

TEST(LabelBelief, TheOrderOfObservationsDoesNotMatter) {
  LabelBelief a, b;
  const std::vector<std::pair<std::uint8_t, float>> seen{{1, 1}, {2, 3}, {1, 2.5F}, {4, 2}};
  for (const auto& [id, evidence] : seen) a.Add(id, evidence);
  for (auto it = seen.rbegin(); it != seen.rend(); ++it) b.Add(it->first, it->second);
  EXPECT_EQ(a.Best(), b.Best());
  EXPECT_EQ(a.Confidence(), b.Confidence());
}

TEST(LabelBelief, AClassThatComesLateStillWins) {
  LabelBelief belief;
  for (std::uint8_t id = 0; id < 6; ++id) belief.Add(id, 3);
  for (int i = 0; i < 3; ++i) belief.Add(9, 3);
  EXPECT_EQ(belief.Best(), 9);
  EXPECT_GT(belief.Confidence(), 200);
}

TEST(LabelBelief, WhatWasLongBelievedCanChange) {
  LabelBelief belief;
  for (int i = 0; i < 1000; ++i) belief.Add(3, 5);
  EXPECT_EQ(belief.Best(), 3);
  EXPECT_EQ(belief.Confidence(), 255);
  int needed = 0;
  while (belief.Best() == 3 && needed < 100) {
    belief.Add(kNoLabel, 4);
    ++needed;
  }
  EXPECT_EQ(needed, 6);
}

TEST(LabelBelief, ManyClassesGiveTheAnswerOfAllWeightsHeld) {
  RandomEngine engine = MakeRandomEngine(1, 0);
  int right = 0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    LabelBelief belief;
    std::array<double, 81> weights{};
    for (int i = 0; i < 12; ++i) {
      const bool is_true_class = UniformReal(engine) < .5;
      const auto id = static_cast<std::uint8_t>(is_true_class ? 40 : 81 * UniformReal(engine));
      const auto evidence = static_cast<float>(.5 + UniformReal(engine));
      belief.Add(id, evidence);
      weights[id] += evidence;
    }
    const auto best = std::max_element(weights.begin(), weights.end()) - weights.begin();
    right += belief.Best() == best;
  }
  EXPECT_GE(right, kTrials * 95 / 100);
}

}  // namespace
}  // namespace ofm
