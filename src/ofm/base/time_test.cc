#include "ofm/base/time.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace ofm {
namespace {

constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();

TEST(ParseSeconds, ReadsARecordedStampExactly) {
  EXPECT_EQ(ParseSeconds("1305031453.359684"), 1305031453'359684000);
  EXPECT_EQ(ParseSeconds("1305031453.123456789"), 1305031453'123456789);
}

TEST(ParseSeconds, ReadsNumbersWithFewDecimalsOrNone) {
  EXPECT_EQ(ParseSeconds("0"), 0);
  EXPECT_EQ(ParseSeconds("7"), 7'000'000'000);
  EXPECT_EQ(ParseSeconds("7."), 7'000'000'000);
  EXPECT_EQ(ParseSeconds("0.5"), 500'000'000);
  EXPECT_EQ(ParseSeconds("0.000000001"), 1);
}

TEST(ParseSeconds, ReadsNegativeTimes) {
  EXPECT_EQ(ParseSeconds("-0.25"), -250'000'000);
  EXPECT_EQ(ParseSeconds("-3.000000001"), -3'000'000'001);
  EXPECT_EQ(ParseSeconds("-0"), 0);
}

TEST(ParseSeconds, CutsOffWhatIsFinerThanANanosecond) {
  EXPECT_EQ(ParseSeconds("1.0000000019"), 1'000'000'001);
  EXPECT_EQ(ParseSeconds("0.99999999999999999999"), 999'999'999);
}

TEST(ParseSeconds, RejectsWhatIsNoDecimalNumber) {
  for (const char* text : {"", "-", ".", ".5", "-.5", "+1", "--1", "1.2.3", "1.-2", "1,5", " 1",
                           "1 ", "1e9", "nan", "inf", "0x10", "abc", "1.5s"}) {
    EXPECT_FALSE(ParseSeconds(text).has_value()) << "'" << text << "'";
  }
}

TEST(ParseSeconds, RejectsWhatWouldOverflow) {
  EXPECT_EQ(ParseSeconds("9000000000.999999999"), 9'000'000'000'999'999'999);
  EXPECT_FALSE(ParseSeconds("9000000001").has_value());
  EXPECT_FALSE(ParseSeconds("9999999999").has_value());
  EXPECT_FALSE(ParseSeconds("1403636579763555584").has_value()) << "nanoseconds are not seconds";
}

TEST(FormatSeconds, WritesMicrosecondsByDefault) {
  EXPECT_EQ(FormatSeconds(1305031453'359684000), "1305031453.359684");
  EXPECT_EQ(FormatSeconds(0), "0.000000");
}

TEST(FormatSeconds, PadsDecimalsWithZeros) {
  EXPECT_EQ(FormatSeconds(1, 9), "0.000000001");
  EXPECT_EQ(FormatSeconds(5'000'000'000, 3), "5.000");
  EXPECT_EQ(FormatSeconds(5'000'000'000, 0), "5");
}

TEST(FormatSeconds, RoundsHalfAwayFromZeroAndCarries) {
  EXPECT_EQ(FormatSeconds(1'999'999'500), "2.000000");
  EXPECT_EQ(FormatSeconds(1'999'999'499), "1.999999");
  EXPECT_EQ(FormatSeconds(-1'999'999'500), "-2.000000");
  EXPECT_EQ(FormatSeconds(500'000'000, 0), "1");
  EXPECT_EQ(FormatSeconds(499'999'999, 0), "0");
}

TEST(FormatSeconds, WritesNoMinusBeforeZero) {
  EXPECT_EQ(FormatSeconds(-499), "0.000000");
  EXPECT_EQ(FormatSeconds(-500), "-0.000001");
  EXPECT_EQ(FormatSeconds(-1, 0), "0");
}

TEST(FormatSeconds, WritesTheEndsOfTheRange) {
  EXPECT_EQ(FormatSeconds(kMax, 9), "9223372036.854775807");
  EXPECT_EQ(FormatSeconds(kMin, 9), "-9223372036.854775808");
  EXPECT_EQ(FormatSeconds(kMax, 0), "9223372037");
  EXPECT_EQ(FormatSeconds(kMin, 0), "-9223372037");
}

TEST(FormatSeconds, TakesNoughtToNineDecimals) {
  EXPECT_THROW(FormatSeconds(0, -1), std::logic_error);
  EXPECT_THROW(FormatSeconds(0, 10), std::logic_error);
}

TEST(FormatSeconds, IsReadBackExactlyWithNineDecimals) {
  for (const std::int64_t stamp_ns :
       {std::int64_t{0}, std::int64_t{1}, std::int64_t{-1}, std::int64_t{999'999'999},
        std::int64_t{-1'000'000'001}, std::int64_t{1305031453'359684001}}) {
    EXPECT_EQ(ParseSeconds(FormatSeconds(stamp_ns, 9)), stamp_ns);
  }
}

TEST(SecondsToNanoseconds, RoundsToTheNearest) {
  EXPECT_EQ(SecondsToNanoseconds(0.02), 20'000'000);
  EXPECT_EQ(SecondsToNanoseconds(-0.02), -20'000'000);
  EXPECT_EQ(SecondsToNanoseconds(1.4e-9), 1);
  EXPECT_EQ(SecondsToNanoseconds(1.6e-9), 2);
}

TEST(NanosecondsToSeconds, IsTheInverseForShortTimes) {
  EXPECT_DOUBLE_EQ(NanosecondsToSeconds(1'500'000'000), 1.5);
  EXPECT_EQ(SecondsToNanoseconds(NanosecondsToSeconds(123'456'789)), 123'456'789);
}

}  // namespace
}  // namespace ofm
