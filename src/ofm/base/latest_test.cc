#include "ofm/base/latest.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

namespace ofm {
namespace {

using Value = std::shared_ptr<const int>;

TEST(Latest, HasTheDefaultValueUntilOneIsSet) {
  const Latest<Value> latest;
  EXPECT_EQ(latest.Get(), nullptr);
}

TEST(Latest, GivesTheNewestValueAsOftenAsAsked) {
  Latest<int> latest;
  latest.Set(1);
  latest.Set(2);
  EXPECT_EQ(latest.Get(), 2);
  EXPECT_EQ(latest.Get(), 2);
}

TEST(Latest, LetsGoOfTheValueBefore) {
  Latest<Value> latest;
  const Value first = std::make_shared<int>(1);
  latest.Set(first);
  EXPECT_EQ(first.use_count(), 2);
  latest.Set(nullptr);
  EXPECT_EQ(first.use_count(), 1);
}

TEST(Latest, ReturnsAtOnceWhenTheValueIsAcceptedAlready) {
  Latest<int> latest;
  latest.Set(3);
  latest.WaitUntil([](int value) { return value == 3; });
  EXPECT_EQ(latest.Get(), 3);
}

TEST(Latest, WaitsForAValueThatIsAccepted) {
  Latest<int> latest;
  std::atomic<bool> accepted = false;
  std::jthread reader([&] {
    latest.WaitUntil([](int value) { return value >= 2; });
    accepted = true;
  });
  latest.Set(1);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_FALSE(accepted);
  latest.Set(2);
  reader.join();
  EXPECT_TRUE(accepted);
}

TEST(Latest, ReadersSeeValuesInOrderAndWhole) {
  struct Pair {
    int a = 0, b = 0;
  };
  Latest<Pair> latest;
  constexpr int kLast = 5000;
  std::jthread writer([&] {
    for (int i = 1; i <= kLast; ++i) latest.Set({i, i});
  });
  int seen = 0;
  while (seen < kLast) {
    const Pair pair = latest.Get();
    ASSERT_EQ(pair.a, pair.b);
    ASSERT_GE(pair.a, seen);
    seen = pair.a;
  }
}

}  // namespace
}  // namespace ofm
