#include "ofm/io/prefetching_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

#include "ofm/base/error.h"

namespace ofm {
namespace {

/// Gives `count` frames, then throws or ends.
class FakeSource : public FrameSource {
 public:
  enum class End { kQuiet, kError };

  FakeSource(int count, End end, std::atomic<int>* given = nullptr)
      : count_(count), end_(end), given_(given) {}

  std::optional<RgbdFrame> Next() override {
    if (next_ == count_) {
      if (end_ == End::kError) throw Error("rgb.txt", 7, "is bad");
      return {};
    }
    RgbdFrame frame;
    frame.id = FrameId(static_cast<std::uint32_t>(next_++));
    if (given_ != nullptr) ++*given_;
    return frame;
  }
  std::optional<std::size_t> size() const override { return count_; }

 private:
  int count_, next_ = 0;
  End end_;
  std::atomic<int>* given_;
};

TEST(PrefetchingSource, GivesAllFramesInOrder) {
  PrefetchingSource source(std::make_unique<FakeSource>(100, FakeSource::End::kQuiet), 3);
  EXPECT_EQ(source.size(), 100u);
  for (int i = 0; i < 100; ++i) {
    const auto frame = source.Next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->id, FrameId(i));
  }
  EXPECT_FALSE(source.Next());
  EXPECT_FALSE(source.Next());
}

TEST(PrefetchingSource, AnErrorComesAfterTheFramesBeforeIt) {
  PrefetchingSource source(std::make_unique<FakeSource>(3, FakeSource::End::kError), 8);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(source.Next()->id, FrameId(i));
  try {
    source.Next();
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "rgb.txt:7: is bad");
    EXPECT_EQ(error.line(), 7);
  }
  EXPECT_FALSE(source.Next());
}

TEST(PrefetchingSource, CanGoWhileItsThreadWaitsForRoom) {
  std::atomic<int> given = 0;
  {
    PrefetchingSource source(
        std::make_unique<FakeSource>(1'000'000, FakeSource::End::kQuiet, &given), 2);
    EXPECT_TRUE(source.Next());
  }
  EXPECT_GE(given, 1);
  EXPECT_LE(given, 4);  // one taken, two waiting, one in hand
}

TEST(PrefetchingSource, CanGoUnused) {
  for (int i = 0; i < 20; ++i) {
    PrefetchingSource source(std::make_unique<FakeSource>(5, FakeSource::End::kError), 1);
  }
}

TEST(PrefetchingSource, WantsASource) {
  EXPECT_THROW(PrefetchingSource(nullptr, 1), std::logic_error);
}

}  // namespace
}  // namespace ofm
