#include "ofm/objects/object_association.h"

#include <gtest/gtest.h>

#include "ofm/objects/test_patch.h"

namespace ofm {
namespace {

using test::Patch;
using Hypotheses = std::vector<ObjectHypothesis>;

constexpr std::uint32_t kBook = 1, kLaptop = 2, kTable = 3, kTv = 4;

/// Each list is what one key frame saw.
Hypotheses Associate(const std::vector<std::vector<PlacedObservation>>& keyframes) {
  Hypotheses hypotheses;
  for (const auto& observations : keyframes) AssociateKeyframe(observations, {}, hypotheses);
  return hypotheses;
}

struct Place {
  double from, to, behind = 0;
};

ObjectHypothesis Views(std::uint32_t first, std::uint32_t count, std::uint32_t class_id,
                       const Place& at) {
  ObjectHypothesis hypothesis(.04);
  for (std::uint32_t id = first; id < first + count; ++id) {
    hypothesis.Add(Patch(id, class_id, at.from, at.to, at.behind));
  }
  return hypothesis;
}

TEST(AssociateKeyframe, JoinsPartialViewsOfOneClass) {
  const Hypotheses found =
      Associate({{Patch(0, kBook, 0, .2)}, {Patch(1, kBook, .1, .4)}, {Patch(2, kBook, 0, .4)}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].views().size(), 3U);
}

TEST(AssociateKeyframe, JoinsAMistakenClassOfTheSameThingAndNoThingOnIt) {
  EXPECT_EQ(Associate({{Patch(0, kBook, 0, .3)}, {Patch(1, kLaptop, 0.02, .32)}}).size(), 1U);
  EXPECT_EQ(Associate({{Patch(0, kTable, 0, 1.5)}, {Patch(1, kBook, .4, .7)}}).size(), 2U);
}

TEST(AssociateKeyframe, TwoInstancesOfOneKeyframeAreTwoUnlessTheyOverlap) {
  EXPECT_EQ(Associate({{Patch(0, kBook, 0, .4)}, {Patch(1, kBook, 0, .2), Patch(1, kBook, .2, .4)}})
                .size(),
            2U);
  EXPECT_EQ(Associate({{Patch(0, kBook, 0, .4)}, {Patch(1, kBook, 0, .4), Patch(1, kBook, 0, .3)}})
                .size(),
            1U);
}

TEST(AssociateKeyframe, GoesToTheOneWithMostOverlap) {
  const Hypotheses found =
      Associate({{Patch(0, kBook, 0, .2), Patch(0, kBook, .2, .4)}, {Patch(1, kBook, .16, .38)}});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[1].views().size(), 2U);
}

TEST(MergeHypotheses, MergesWhatOverlapsUnlessKeyframesToldThemApart) {
  Hypotheses doubles{Views(0, 4, kBook, {0, .3}), Views(4, 4, kBook, {.1, .4}),
                     Views(8, 4, kBook, {1, 1.3})};
  MergeHypotheses({}, doubles);
  ASSERT_EQ(doubles.size(), 2U);
  EXPECT_EQ(doubles[0].views().size(), 8U);

  Hypotheses apart{Views(0, 4, kBook, {0, .3}), Views(2, 4, kBook, {.1, .4})};
  MergeHypotheses({}, apart);
  EXPECT_EQ(apart.size(), 2U) << "two of four views had both";
}

TEST(MergeNear, MergesOneScreenWithBadDepthAndNoNeighbours) {
  Hypotheses screen{Views(0, 3, kTv, {0, .5}), Views(3, 3, kTv, {0, .5, .16}),
                    Views(6, 3, kLaptop, {0, .5, -.12})};
  MergeNear({}, screen);
  EXPECT_EQ(screen.size(), 1U);

  Hypotheses apart{Views(0, 3, kTv, {0, .5}), Views(2, 3, kTv, {0, .5, .16}),
                   Views(6, 3, kTv, {.6, 1.1}), Views(9, 3, kBook, {0, .1, -.06})};
  MergeNear({}, apart);
  EXPECT_EQ(apart.size(), 4U) << "seen in one key frame; beside; too small to be the screen";
}

TEST(DropParts, DropsAWeakOneWithinALikeSizedOneOnly) {
  Hypotheses parts{Views(0, 9, kLaptop, {0, .4}), Views(0, 2, kBook, {0, .2})};
  DropParts({}, parts);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].BestClass(), ClassId(kLaptop));

  Hypotheses small{Views(0, 9, kTable, {0, 2}), Views(0, 2, kBook, {.5, .7})};
  DropParts({}, small);
  EXPECT_EQ(small.size(), 2U) << "it lies on the other";

  Hypotheses strong{Views(0, 9, kLaptop, {0, .4}), Views(0, 8, kBook, {0, .2})};
  DropParts({}, strong);
  EXPECT_EQ(strong.size(), 2U);
}

}  // namespace
}  // namespace ofm
