#include "ofm/base/bounded_queue.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <numeric>
#include <thread>
#include <vector>

namespace ofm {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

template <class T>
std::vector<T> Drain(BoundedQueue<T>& queue) {
  std::vector<T> values;
  while (std::optional<T> value = queue.TryPop()) values.push_back(std::move(*value));
  return values;
}

// Long enough that a thread which does not wait would be seen not to wait.
void LetOthersRun() { std::this_thread::sleep_for(std::chrono::milliseconds(20)); }

TEST(BoundedQueue, IsFirstInFirstOut) {
  BoundedQueue<int> queue(3);
  for (const int value : {1, 2, 3}) EXPECT_TRUE(queue.Push(value));
  EXPECT_EQ(queue.size(), 3u);
  EXPECT_EQ(queue.Pop(), 1);
  EXPECT_EQ(queue.Pop(), 2);
  EXPECT_EQ(queue.TryPop(), 3);
  EXPECT_EQ(queue.TryPop(), std::nullopt);
  EXPECT_EQ(queue.dropped(), 0u);
}

TEST(BoundedQueue, CarriesValuesThatCanOnlyBeMoved) {
  BoundedQueue<std::unique_ptr<int>> queue(1);
  EXPECT_TRUE(queue.Push(std::make_unique<int>(7)));
  EXPECT_EQ(**queue.Pop(), 7);
}

TEST(BoundedQueue, NeedsRoomForOne) { EXPECT_THROW(BoundedQueue<int>(0), std::logic_error); }

TEST(BoundedQueue, BlockedProducerWaitsForRoom) {
  BoundedQueue<int> queue(1, OverflowPolicy::kBlock);
  queue.Push(1);
  std::atomic<bool> pushed = false;
  std::jthread producer([&] {
    queue.Push(2);
    pushed = true;
  });
  LetOthersRun();
  EXPECT_FALSE(pushed);
  EXPECT_EQ(queue.Pop(), 1);
  EXPECT_EQ(queue.Pop(), 2);
  EXPECT_EQ(queue.dropped(), 0u);
}

TEST(BoundedQueue, DropOldestKeepsTheNewestValues) {
  BoundedQueue<int> queue(2, OverflowPolicy::kDropOldest);
  for (const int value : {1, 2, 3, 4, 5}) EXPECT_TRUE(queue.Push(value));
  EXPECT_EQ(queue.dropped(), 3u);
  EXPECT_THAT(Drain(queue), ElementsAre(4, 5));
}

TEST(BoundedQueue, LatestOnlyKeepsOneValueWhateverTheCapacity) {
  BoundedQueue<int> queue(8, OverflowPolicy::kLatestOnly);
  for (const int value : {1, 2, 3}) EXPECT_TRUE(queue.Push(value));
  EXPECT_EQ(queue.dropped(), 2u);
  EXPECT_THAT(Drain(queue), ElementsAre(3));
}

TEST(BoundedQueue, ConsumerWaitsForAValue) {
  BoundedQueue<int> queue(1);
  std::optional<int> popped;
  std::jthread consumer([&] { popped = queue.Pop(); });
  LetOthersRun();
  queue.Push(5);
  consumer.join();
  EXPECT_EQ(popped, 5);
}

TEST(BoundedQueue, CloseLetsConsumersDrainWhatIsLeft) {
  BoundedQueue<int> queue(2);
  queue.Push(1);
  queue.Push(2);
  queue.Close();
  EXPECT_FALSE(queue.Push(3));
  EXPECT_EQ(queue.Pop(), 1);
  EXPECT_EQ(queue.Pop(), 2);
  EXPECT_EQ(queue.Pop(), std::nullopt);
}

TEST(BoundedQueue, PushAfterCloseDropsNothing) {
  for (const OverflowPolicy policy : {OverflowPolicy::kDropOldest, OverflowPolicy::kLatestOnly}) {
    BoundedQueue<int> queue(1, policy);
    queue.Push(1);
    queue.Close();
    EXPECT_FALSE(queue.Push(2));
    EXPECT_EQ(queue.dropped(), 0u);
    EXPECT_THAT(Drain(queue), ElementsAre(1));
  }
}

TEST(BoundedQueue, CloseWakesAWaitingConsumer) {
  BoundedQueue<int> queue(1);
  std::optional<int> popped = 9;
  std::jthread consumer([&] { popped = queue.Pop(); });
  LetOthersRun();
  queue.Close();
  consumer.join();
  EXPECT_EQ(popped, std::nullopt);
}

TEST(BoundedQueue, CloseWakesAWaitingProducerWhoseValueIsLost) {
  BoundedQueue<int> queue(1);
  queue.Push(1);
  bool pushed = true;
  std::jthread producer([&] { pushed = queue.Push(2); });
  LetOthersRun();
  queue.Close();
  producer.join();
  EXPECT_FALSE(pushed);
  EXPECT_THAT(Drain(queue), ElementsAre(1));
}

TEST(BoundedQueue, StopRequestWakesAWaitingConsumer) {
  BoundedQueue<int> queue(1);
  std::optional<int> popped = 9;
  std::jthread consumer([&](std::stop_token stop) { popped = queue.Pop(stop); });
  LetOthersRun();
  consumer.request_stop();
  consumer.join();
  EXPECT_EQ(popped, std::nullopt);
}

TEST(BoundedQueue, StopRequestWakesAWaitingProducer) {
  BoundedQueue<int> queue(1);
  queue.Push(1);
  bool pushed = true;
  std::jthread producer([&](std::stop_token stop) { pushed = queue.Push(2, stop); });
  LetOthersRun();
  producer.request_stop();
  producer.join();
  EXPECT_FALSE(pushed);
  EXPECT_THAT(Drain(queue), ElementsAre(1));
}

TEST(BoundedQueue, StoppedConsumerLeavesTheValuesToOthers) {
  BoundedQueue<int> queue(1);
  queue.Push(1);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(queue.Pop(stop.get_token()), std::nullopt);
  EXPECT_THAT(Drain(queue), ElementsAre(1));
}

// Two producers, two consumers: no value is lost or doubled, and each producer's order is kept.
TEST(BoundedQueue, LosesNothingBetweenThreadsWhenItBlocks) {
  constexpr int kPerProducer = 500;
  BoundedQueue<int> queue(3, OverflowPolicy::kBlock);
  std::vector<int> taken[2];
  {
    std::vector<std::jthread> consumers;
    for (std::vector<int>& mine : taken) {
      consumers.emplace_back([&queue, &mine] {
        while (const std::optional<int> value = queue.Pop()) mine.push_back(*value);
      });
    }
    {
      std::vector<std::jthread> producers;
      for (int p = 0; p < 2; ++p) {
        producers.emplace_back([&queue, p] {
          for (int i = 0; i < kPerProducer; ++i) queue.Push(p * kPerProducer + i);
        });
      }
    }
    queue.Close();
  }
  for (const std::vector<int>& mine : taken) {
    int last[2] = {-1, -1};
    for (const int value : mine) {
      EXPECT_GT(value, last[value / kPerProducer]);
      last[value / kPerProducer] = value;
    }
  }
  std::vector<int> all = taken[0];
  all.insert(all.end(), taken[1].begin(), taken[1].end());
  std::sort(all.begin(), all.end());
  std::vector<int> expected(2 * kPerProducer);
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(all, expected);
}

// A fast producer never waits; what the consumer sees is in order, and dropped() accounts for the
// rest.
TEST(BoundedQueue, AccountsForEveryValueWhenItDrops) {
  for (const OverflowPolicy policy : {OverflowPolicy::kDropOldest, OverflowPolicy::kLatestOnly}) {
    constexpr int kValues = 2000;
    BoundedQueue<int> queue(4, policy);
    std::vector<int> taken;
    {
      std::jthread consumer([&] {
        while (const std::optional<int> value = queue.Pop()) taken.push_back(*value);
      });
      for (int i = 0; i < kValues; ++i) ASSERT_TRUE(queue.Push(i));
      queue.Close();
    }
    EXPECT_TRUE(std::is_sorted(taken.begin(), taken.end()));
    EXPECT_EQ(taken.size() + queue.dropped(), std::size_t{kValues});
    ASSERT_FALSE(taken.empty());
    EXPECT_EQ(taken.back(), kValues - 1) << "the newest value always arrives";
    EXPECT_THAT(Drain(queue), IsEmpty());
  }
}

}  // namespace
}  // namespace ofm
