#include "ofm/perception/instance_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "ofm/base/error.h"
#include "ofm/io/atomic_file.h"
#include "ofm/io/read_file.h"
#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

using testing::HasSubstr;

const std::vector<std::string> kNames = {"person", "chair"};

Instance MakeInstance(ClassId class_id, float score, const cv::Rect& box) {
  Instance instance{{}, class_id, score, box, cv::Mat::zeros(6, 8, CV_8UC1)};
  instance.mask(box).setTo(255);
  return instance;
}

class InstanceFile : public testing::Test {
 protected:
  std::string ErrorOf(const std::string& text) const {
    WriteFileAtomically(path_, text);
    try {
      LoadInstances(path_, {8, 6}, kNames);
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(path_.string()));
      return error.what();
    }
    return "no error";
  }

  TestFolder folder_;
  std::filesystem::path path_ = folder_.path() / "1.5.json";
};

TEST_F(InstanceFile, GivesBackWhatWasWritten) {
  Segmentation written;
  written.instances.push_back(MakeInstance(ClassId(1), 0.123456789F, {2, 1, 3, 4}));
  written.instances.push_back(MakeInstance(ClassId(0), 0.9F, {0, 0, 4, 6}));  // overlaps
  SaveInstances(path_, written, kNames);
  const Segmentation read = LoadInstances(path_, {8, 6}, kNames);
  ASSERT_EQ(read.instances.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.instances[i].class_id, written.instances[i].class_id);
    EXPECT_EQ(read.instances[i].score, written.instances[i].score);
    EXPECT_EQ(read.instances[i].box, written.instances[i].box);
    EXPECT_EQ(cv::countNonZero(read.instances[i].mask != written.instances[i].mask), 0);
  }
}

TEST_F(InstanceFile, CountsRunsDownTheColumnsAsCocoDoes) {
  Segmentation written;
  written.instances.push_back(MakeInstance(ClassId(0), 1, {1, 2, 1, 3}));
  SaveInstances(path_, written, kNames);
  EXPECT_THAT(ReadFile(path_), HasSubstr("\"counts\":[8,3,37]"));
}

TEST_F(InstanceFile, MaskThatBeginsAtTheCornerHasNoZerosFirst) {
  Segmentation written;
  written.instances.push_back(MakeInstance(ClassId(0), 1, {0, 0, 8, 6}));
  SaveInstances(path_, written, kNames);
  EXPECT_THAT(ReadFile(path_), HasSubstr("\"counts\":[0,48]"));
}

TEST_F(InstanceFile, NoInstancesAreAnEmptyList) {
  SaveInstances(path_, {}, kNames);
  EXPECT_TRUE(LoadInstances(path_, {8, 6}, kNames).instances.empty());
}

TEST_F(InstanceFile, SaysWhatIsWrong) {
  const auto with = [](const std::string& category, const std::string& size,
                       const std::string& counts, const std::string& score) {
    return R"([{"category":")" + category + R"(","score":)" + score +
           R"(,"segmentation":{"size":)" + size + R"(,"counts":)" + counts + "}}]";
  };
  EXPECT_THAT(ErrorOf("[{"), HasSubstr("is no list of instances"));
  EXPECT_THAT(ErrorOf("[{}]"), HasSubstr("is no list of instances"));
  EXPECT_THAT(ErrorOf(with("dog", "[6,8]", "[48]", "1")), HasSubstr("unknown class 'dog'"));
  EXPECT_THAT(ErrorOf(with("chair", "[8,6]", "[48]", "1")), HasSubstr("8 x 6"));
  EXPECT_THAT(ErrorOf(with("chair", "[6,8]", "[47]", "1")), HasSubstr("do not fill"));
  EXPECT_THAT(ErrorOf(with("chair", "[6,8]", "[40,9]", "1")), HasSubstr("do not fit"));
  EXPECT_THAT(ErrorOf(with("chair", "[6,8]", "[-1,49]", "1")), HasSubstr("do not fit"));
  EXPECT_THAT(ErrorOf(with("chair", "[6,8]", "[48]", "2")), HasSubstr("score"));
  EXPECT_EQ(ErrorOf(with("chair", "[6,8]", "[40,8]", "1")), "no error");
}

}  // namespace
}  // namespace ofm
