// How settings reach a run, and the configurations that are shipped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/pipeline/options.h"
#include "test_recording.h"

namespace ofm {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

/// The options that `run --print-config` prints with these arguments.
SlamOptions PrintedOptions(const std::string& arguments) {
  const TestFolder folder;
  const ProgramResult result = RunProgram("run --print-config " + arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  SlamOptions options;
  LoadOptionsYaml(folder.Write("printed.yaml", result.out), OptionFields(options));
  return options;
}

std::string Yaml(SlamOptions options) { return PrintOptionsYaml(OptionFields(options)); }

SlamOptions ShippedOptions(const std::string& name) {
  SlamOptions options;
  LoadOptionsYaml(std::filesystem::path(OFM_SOURCE_DIR) / "configs" / name, OptionFields(options));
  return options;
}

TEST(PrintConfig, PrintsTheDefaultsWithTheirDocumentation) {
  const ProgramResult result = RunProgram("run --print-config");
  EXPECT_EQ(result.out, Yaml({}));
  EXPECT_THAT(result.out, AllOf(HasSubstr("# "), HasSubstr("features:"), HasSubstr("[px]")));
}

TEST(PrintConfig, WhatItPrintsLoadsBackToTheSame) {
  const TestFolder folder;
  const ProgramResult first = RunProgram(
      "run --print-config --seed 7 --segmenter mask-rcnn --model 'a b.pb' --model-graph c.pbtxt "
      "--dynamics off --vocabulary my.voc "
      "--set features.count=700 --set 'dynamics.dynamic_classes=person, dog'");
  const std::string file = folder.Write("my.yaml", first.out).string();
  const ProgramResult second = RunProgram("run --print-config --config " + file);
  EXPECT_EQ(second.out, first.out);
  const SlamOptions options = PrintedOptions("--config " + file);
  EXPECT_EQ(options.seed, 7U);
  EXPECT_EQ(options.perception.segmenter, SegmenterKind::kMaskRcnn);
  EXPECT_EQ(options.perception.model, "a b.pb");
  EXPECT_EQ(options.perception.model_graph, "c.pbtxt");
  EXPECT_EQ(options.dynamics.mode, DynamicsMode::kOff);
  EXPECT_EQ(options.vocabulary, "my.voc");
  EXPECT_EQ(options.features.count, 700);
  EXPECT_THAT(options.dynamics.dynamic_classes, testing::ElementsAre("person", "dog"));
}

TEST(OptionArguments, ShortCutsOverrideTheFileAndSetOverridesAll) {
  const TestFolder folder;
  const std::string file =
      folder.Write("my.yaml", "seed: 1\nperception:\n  segmenter: masks\nfeatures:\n  count: 600\n")
          .string();
  EXPECT_EQ(PrintedOptions("--config " + file).perception.segmenter, SegmenterKind::kMasks);
  const SlamOptions options = PrintedOptions(
      "--config " + file + " --segmenter none --seed 2 --set features.count=601 --set seed=3");
  EXPECT_EQ(options.perception.segmenter, SegmenterKind::kNone);
  EXPECT_EQ(options.features.count, 601);
  EXPECT_EQ(options.seed, 3U);
}

TEST(OptionArguments, OfTwoAssignmentsTheLaterHolds) {
  EXPECT_EQ(PrintedOptions("--set features.count=600 --set features.count=700").features.count,
            700);
}

TEST(ShippedConfigs, DefaultHoldsTheDefaults) {
  EXPECT_EQ(ReadFile(std::filesystem::path(OFM_SOURCE_DIR) / "configs" / "default.yaml"), Yaml({}))
      << "make it anew: ofm-slam run --print-config > configs/default.yaml";
}

TEST(ShippedConfigs, PaperCullsAsInThePaper) {
  const SlamOptions options = ShippedOptions("paper.yaml");
  EXPECT_EQ(options.dynamics.mode, DynamicsMode::kPaper);
  EXPECT_THAT(options.dynamics.dynamic_classes, testing::ElementsAre("person"));
  EXPECT_EQ(options.perception.segmenter, SegmenterKind::kYoloSeg);
  EXPECT_FALSE(options.tracking.alignment.enabled);  // not in the paper
}

}  // namespace
}  // namespace ofm
