#include "ofm/dense/label_votes.h"

#include <gtest/gtest.h>

namespace ofm {
namespace {

TEST(LabelVotes, NothingIsKnownWithoutVotes) {
  EXPECT_EQ(LabelVotes().Best(), kNoLabel);
  EXPECT_EQ(LabelVotes().Confidence(), 0);
}

TEST(LabelVotes, AConfidentVoteBeatsTwoDoubtfulOnes) {
  LabelVotes votes;
  votes.Add(3, 60);
  votes.Add(3, 60);
  votes.Add(7, 200);
  EXPECT_EQ(votes.Best(), 7);
  EXPECT_EQ(votes.Confidence(), 67);  // 200 / 3
}

TEST(LabelVotes, ManyVotesBeatOne) {
  LabelVotes votes;
  votes.Add(7, 200);
  for (int i = 0; i < 5; ++i) votes.Add(3, 60);
  EXPECT_EQ(votes.Best(), 3);
}

TEST(LabelVotes, BackgroundCompetesWithLabels) {
  LabelVotes votes;
  votes.Add(3, 250);
  votes.Add(kNoLabel, 128);
  EXPECT_EQ(votes.Best(), 3);
  votes.Add(kNoLabel, 128);
  EXPECT_EQ(votes.Best(), kNoLabel);
}

TEST(LabelVotes, AClassThatComesLateStillWins) {
  LabelVotes votes;
  for (std::uint8_t id = 0; id < 3; ++id) votes.Add(id, 100);
  for (int i = 0; i < 5; ++i) votes.Add(9, 100);
  EXPECT_EQ(votes.Best(), 9);
}

TEST(LabelVotes, AVoteWithoutConfidenceOnlyLowersTheMean) {
  LabelVotes votes;
  votes.Add(4, 200);
  votes.Add(5, 0);
  EXPECT_EQ(votes.Best(), 4);
  EXPECT_EQ(votes.Confidence(), 100);
}

}  // namespace
}  // namespace ofm
