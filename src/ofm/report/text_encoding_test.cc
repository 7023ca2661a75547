#include "ofm/report/text_encoding.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

namespace ofm {
namespace {

TEST(EscapeHtml, LeavesNothingThatBeginsATagOrEndsAnAttribute) {
  EXPECT_EQ(EscapeHtml("<b a='1' c=\"2\">&</b>"),
            "&lt;b a=&#39;1&#39; c=&quot;2&quot;&gt;&amp;&lt;/b&gt;");
  EXPECT_EQ(EscapeHtml("a\nb\tc é"), "a\nb\tc é");
  EXPECT_EQ(EscapeHtml(std::string_view("a\0b\x1b\x7f", 5)),
            "a\xEF\xBF\xBD"
            "b\xEF\xBF\xBD\xEF\xBF\xBD");
  EXPECT_EQ(EscapeHtml(""), "");
}

TEST(EncodeBase64, IsThatOfTheStandard) {
  // RFC 4648, section 10.
  const auto encode = [](std::string_view text) {
    return EncodeBase64(std::vector<unsigned char>(text.begin(), text.end()));
  };
  EXPECT_EQ(encode(""), "");
  EXPECT_EQ(encode("f"), "Zg==");
  EXPECT_EQ(encode("fo"), "Zm8=");
  EXPECT_EQ(encode("foobar"), "Zm9vYmFy");
}

TEST(JsonForScript, CannotEndTheScript) {
  const nlohmann::ordered_json json = {{"name", "</script><script>é\xff"}};
  const std::string text = JsonForScript(json);
  EXPECT_EQ(text.find('<'), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(text)["name"], "</script><script>é\xEF\xBF\xBD");
}

}  // namespace
}  // namespace ofm
