#include "ofm/base/options.h"

#include <gmock/gmock.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>

#include "ofm/base/error.h"

namespace ofm {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

enum class Color { kRed, kDarkBlue };

EnumNameList<Color> EnumNames(Color) {
  static constexpr std::array<std::pair<Color, std::string_view>, 2> kNames{
      {{Color::kRed, "red"}, {Color::kDarkBlue, "dark-blue"}}};
  return kNames;
}

struct InnerOptions {
  double gain = 1.5;
  Color color = Color::kRed;
  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("gain", self.gain, "amplification", Range{0.5, 2});
    visit("color", self.color, "of the line");
  }
};

struct TestOptions {
  int count = 10;
  std::uint64_t seed = 1;
  int huge = 0;
  bool fast = false;
  float share = 0.1f;
  double limit = 0;
  InnerOptions inner;
  std::string name = "desk";
  std::vector<std::string> classes{"person", "dining table"};
  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("count", self.count, "how many", Range{1, 100});
    visit("seed", self.seed, "of all random draws");
    visit("huge", self.huge, "any number");
    visit("fast", self.fast, "skip the slow part");
    visit("share", self.share, "of the image");
    visit("limit", self.limit, "no limits at all");
    visit("inner", self.inner);
    visit("name", self.name, "of the run");
    visit("classes", self.classes, "that may move");
  }
};

class Options : public ::testing::Test {
 protected:
  ~Options() override { std::filesystem::remove(path_); }

  void Load(const std::string& yaml) {
    std::ofstream(path_) << yaml;
    LoadOptionsYaml(path_, OptionFields(options_));
  }
  void Set(const std::string& assignment) {
    ApplyOptionAssignment(assignment, OptionFields(options_));
  }
  // The message of loading `yaml` without its path, which must come first.
  std::string LoadError(const std::string& yaml) {
    try {
      Load(yaml);
    } catch (const Error& error) {
      const std::string what = error.what();
      EXPECT_TRUE(what.starts_with(path_.string() + ":")) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << "not one line: " << what;
      return what.substr(path_.string().size());
    }
    return "no error";
  }

  const std::filesystem::path path_ =
      std::filesystem::path(::testing::TempDir()) /
      (std::string("ofm_options_") +
       ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".yaml");
  TestOptions options_;
};

TEST_F(Options, FieldsComeInDeclarationOrderWithDottedPaths) {
  std::vector<std::string> paths;
  for (const OptionField& field : OptionFields(options_)) paths.push_back(field.path);
  EXPECT_THAT(paths, ElementsAre("count", "seed", "huge", "fast", "share", "limit", "inner.gain",
                                 "inner.color", "name", "classes"));
}

TEST_F(Options, FieldsKnowTheirTypes) {
  std::vector<std::string> types;
  for (const OptionField& field : OptionFields(options_)) types.push_back(field.type);
  EXPECT_THAT(types, ElementsAre("int", "int", "int", "bool", "real", "real", "real",
                                 "red | dark-blue", "text", "list"));
}

TEST_F(Options, YamlSetsWhatItNamesAndLeavesTheRest) {
  Load("count: 7\nfast: yes\ninner:\n  color: dark-blue\nclasses: [cat, potted plant]\n");
  EXPECT_EQ(options_.count, 7);
  EXPECT_TRUE(options_.fast);
  EXPECT_EQ(options_.inner.color, Color::kDarkBlue);
  EXPECT_THAT(options_.classes, ElementsAre("cat", "potted plant"));
  EXPECT_EQ(options_.inner.gain, 1.5);
  EXPECT_EQ(options_.name, "desk");
}

TEST_F(Options, EmptyFileAndEmptyGroupChangeNothing) {
  Load("");
  Load("# only a comment\n");
  Load("inner:\n  # gain: 2\ncount: 5\n");
  Load("inner: {}\n");
  EXPECT_EQ(options_.inner.gain, 1.5);
  EXPECT_EQ(options_.count, 5);
}

TEST_F(Options, ListMayBeEmptyOrInBlockStyle) {
  Load("classes: []\n");
  EXPECT_THAT(options_.classes, IsEmpty());
  Load("classes:\n  - cat\n  - 'a, b'\n  - \"[x]\"\n");
  EXPECT_THAT(options_.classes, ElementsAre("cat", "a, b", "[x]"));
}

TEST_F(Options, UnknownKeyIsAnErrorThatNamesTheLineAndTheLikelyKey) {
  EXPECT_EQ(LoadError("count: 1\ncuont: 2\n"), ":2: unknown key 'cuont'; did you mean 'count'?");
  EXPECT_EQ(LoadError("inner:\n  gian: 1\n"),
            ":2: unknown key 'inner.gian'; did you mean 'inner.gain'?");
  EXPECT_EQ(LoadError("iner:\n  gain: 1\n"),
            ":2: unknown key 'iner.gain'; did you mean 'inner.gain'?");
  EXPECT_THAT(LoadError("outer: {}\n"), HasSubstr(":1: unknown key 'outer'"));
}

TEST_F(Options, SameKeyTwiceIsAnError) {
  EXPECT_EQ(LoadError("count: 1\nfast: true\ncount: 2\n"), ":3: count: is given twice");
}

TEST_F(Options, BadValueIsAnErrorThatNamesLineKeyAndReason) {
  EXPECT_EQ(LoadError("\ncount: many\n"), ":2: count: 'many' is not a finite number");
  EXPECT_EQ(LoadError("count: 2.5\n"), ":1: count: '2.5' is not a whole number");
  EXPECT_EQ(LoadError("count: 0\n"), ":1: count: 0 is outside [1, 100]");
  EXPECT_EQ(LoadError("count: 101\n"), ":1: count: 101 is outside [1, 100]");
  EXPECT_EQ(LoadError("count:\n"), ":1: count: '' is not a finite number");
  EXPECT_EQ(LoadError("fast: maybe\n"), ":1: fast: 'maybe' is neither true nor false");
  EXPECT_EQ(LoadError("inner:\n  color: green\n"),
            ":2: inner.color: 'green' is none of: red | dark-blue");
}

TEST_F(Options, ValueOfTheWrongShapeIsAnError) {
  EXPECT_THAT(LoadError("count: [1, 2]\n"), HasSubstr(":1: count: "));
  EXPECT_THAT(LoadError("name: [a, b]\n"), HasSubstr(":1: name: "));
  EXPECT_THAT(LoadError("count:\n  a: 1\n"), HasSubstr("unknown key 'count.a'"));
  EXPECT_THAT(LoadError("inner: 5\n"), HasSubstr(":1: unknown key 'inner'"));
  EXPECT_THAT(LoadError("classes: [[a], b]\n"), HasSubstr(":1: classes: "));
  EXPECT_THAT(LoadError("[a, b]: 1\n"), HasSubstr(":1: "));
  EXPECT_EQ(LoadError("- count\n"), ":1: must hold 'key: value' entries");
}

TEST_F(Options, NotANumberAndInfinityAreRefused) {
  for (const char* text : {"nan", ".nan", "-nan", "inf", "-inf", ".inf", "1e999"}) {
    EXPECT_THAT(LoadError(std::string("limit: ") + text + "\n"), HasSubstr("finite number"));
  }
  EXPECT_EQ(options_.limit, 0);
}

TEST_F(Options, WholeNumberMustFitItsType) {
  EXPECT_THAT(LoadError("seed: -1\n"), HasSubstr("is outside [0, "));
  EXPECT_THAT(LoadError("huge: -2147483649\n"), HasSubstr("is outside [-2147483648, 2147483647]"));
  EXPECT_THAT(LoadError("seed: 9007199254740993\n"), HasSubstr("is outside"))
      << "a double cannot tell it from its neighbour";
  Load("seed: 9007199254740991\nhuge: -2147483648\n");
  EXPECT_EQ(options_.seed, 9007199254740991u);
  EXPECT_EQ(options_.huge, -2147483648);
}

TEST_F(Options, BrokenYamlIsAnErrorWithItsLine) {
  EXPECT_THAT(LoadError("count: 1\ninner: {gain: 1\n"), HasSubstr("is not valid YAML"));
  EXPECT_THAT(LoadError("count: 1\n\tfast: true\n"), HasSubstr(":2: is not valid YAML"));
}

TEST_F(Options, FileThatCannotBeReadIsAnErrorThatNamesIt) {
  const auto load = [&](const char* path) {
    return [this, path] { LoadOptionsYaml(path, OptionFields(options_)); };
  };
  EXPECT_THAT(load("/nonexistent/a.yaml"),
              ThrowsMessage<Error>(HasSubstr("/nonexistent/a.yaml: cannot be opened")));
  EXPECT_THAT(load("/tmp"), ThrowsMessage<Error>(HasSubstr("/tmp: ")));
}

TEST_F(Options, AssignmentSetsOneField) {
  Set("inner.gain=2");
  Set("name=a=b c");
  Set("classes=cat, dog");
  Set("limit=-1e-3");
  EXPECT_EQ(options_.inner.gain, 2);
  EXPECT_EQ(options_.name, "a=b c");
  EXPECT_THAT(options_.classes, ElementsAre("cat", "dog"));
  EXPECT_EQ(options_.limit, -1e-3);
  Set("classes=");
  EXPECT_THAT(options_.classes, IsEmpty());
}

TEST_F(Options, BadAssignmentIsAnErrorThatNamesIt) {
  EXPECT_THAT([&] { Set("inner.gain"); },
              ThrowsMessage<Error>(AllOf(HasSubstr("'inner.gain'"), HasSubstr("key=value"))));
  EXPECT_THAT([&] { Set("inner.gain=5"); },
              ThrowsMessage<Error>("'inner.gain=5': 5 is outside [0.5, 2]"));
  EXPECT_THAT([&] { Set("gain=1"); }, ThrowsMessage<Error>(HasSubstr("unknown key 'gain'")));
  EXPECT_THAT([&] { Set("classes=[a"); }, ThrowsMessage<Error>(HasSubstr("'classes=[a'")));
}

TEST_F(Options, PrintedYamlHasGroupsValuesAndDocumentation) {
  const std::string text = PrintOptionsYaml(OptionFields(options_));
  EXPECT_EQ(text,
            "count: 10  # how many (int)\n"
            "seed: 1  # of all random draws (int)\n"
            "huge: 0  # any number (int)\n"
            "fast: false  # skip the slow part (bool)\n"
            "share: 0.1  # of the image (real)\n"
            "limit: 0  # no limits at all (real)\n"
            "inner:\n"
            "  gain: 1.5  # amplification (real)\n"
            "  color: red  # of the line (red | dark-blue)\n"
            "name: desk  # of the run (text)\n"
            "classes: [person, dining table]  # that may move (list)\n");
}

TEST_F(Options, PrintedYamlIsReadBackExactly) {
  options_ = {.count = 77,
              .seed = 9007199254740991u,
              .huge = -1,
              .fast = true,
              .share = 0.3f,
              .limit = 0.1 + 0.2,
              .inner = {.gain = 1.0 / 1.7, .color = Color::kDarkBlue},
              .name = "x",
              .classes = {"a, b", "it's", "x: #y", "[z]", "", "null", "\"q\"", "back\\slash"}};
  const std::string text = PrintOptionsYaml(OptionFields(options_));
  const TestOptions written = options_;
  options_ = {};
  Load(text);
  EXPECT_EQ(options_.count, written.count);
  EXPECT_EQ(options_.seed, written.seed);
  EXPECT_EQ(options_.huge, written.huge);
  EXPECT_EQ(options_.fast, written.fast);
  EXPECT_EQ(options_.share, written.share);
  EXPECT_EQ(options_.limit, written.limit);
  EXPECT_EQ(options_.inner.gain, written.inner.gain);
  EXPECT_EQ(options_.inner.color, written.inner.color);
  EXPECT_EQ(options_.classes, written.classes);
}

TEST_F(Options, AnyTextIsReadBackExactly) {
  for (const char* name : {"",
                           "a b",
                           "it's \"so\"",
                           "null",
                           "~",
                           "true",
                           "12",
                           "- x",
                           "-",
                           "[a, b]",
                           "{a: b}",
                           "a: b",
                           "a #b",
                           "#",
                           "?",
                           "!t",
                           "&a",
                           "*a",
                           "%d",
                           "@",
                           "`",
                           "two\nlines",
                           "tab\t",
                           "C:\\dir",
                           " x ",
                           "Grüße",
                           "data/tum_fr1_desk",
                           "https://a.b/c?d=e"}) {
    options_.name = name;
    const std::string text = PrintOptionsYaml(OptionFields(options_));
    options_.name = "overwritten";
    Load(text);
    EXPECT_EQ(options_.name, name) << text;
  }
}

}  // namespace
}  // namespace ofm
