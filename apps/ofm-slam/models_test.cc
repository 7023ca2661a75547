// The networks that the program knows. Downloads come from a server of our own on this machine.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>

#include "test_recording.h"

namespace ofm {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Of "a network\n", by sha256sum.
constexpr const char* kContents = "a network\n";
constexpr const char* kSha256 = "39ecf49ba3c9db743f01bcec112d11d62b942e04dc36665ae2e22552c4401d4f";

/// Serves a folder over HTTP on 127.0.0.1 while it lives.
class LocalServer {
 public:
  LocalServer() {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
    child_ = fork();
    if (child_ == 0) {
      dup2(ends[1], STDOUT_FILENO);
      if (freopen("/dev/null", "w", stderr) == nullptr) _exit(1);
      execlp("python3", "python3", "-u", "-m", "http.server", "0", "--bind", "127.0.0.1",
             "--directory", folder_.path().c_str(), static_cast<char*>(nullptr));
      _exit(1);
    }
    close(ends[1]);
    // "Serving HTTP on 127.0.0.1 port 43211 (http://127.0.0.1:43211/) ..."
    FILE* said = fdopen(ends[0], "r");
    if (fscanf(said, "Serving HTTP on 127.0.0.1 port %d", &port_) != 1) port_ = 0;
    fclose(said);
  }
  ~LocalServer() {
    kill(child_, SIGTERM);
    waitpid(child_, nullptr, 0);
  }
  LocalServer(const LocalServer&) = delete;
  LocalServer& operator=(const LocalServer&) = delete;

  std::string Put(const std::string& name, std::string_view contents) const {
    folder_.Write(name, contents);
    return Address(name);
  }
  std::string Address(const std::string& name) const {
    return "http://127.0.0.1:" + std::to_string(port_) + "/" + name;
  }

 private:
  TestFolder folder_;
  pid_t child_ = -1;
  int port_ = 0;
};

ProgramResult Models(const std::string& arguments) { return RunProgram("models " + arguments); }

class ModelsDownload : public testing::Test {
 protected:
  ProgramResult Download(const std::string& arguments) const {
    return Models("download --to '" + to().string() + "' " + arguments);
  }
  std::filesystem::path to() const { return folder_.path() / "models"; }
  std::size_t CountFiles() const {
    return std::filesystem::exists(to())
               ? static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(to()),
                                                        std::filesystem::directory_iterator()))
               : 0;
  }

  LocalServer server_;
  TestFolder folder_;
};

TEST(Models, ListHasAddressLicenceAndSha256OfEach) {
  const ProgramResult result = Models("");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_THAT(
      result.out,
      AllOf(HasSubstr("NAME"), HasSubstr("LICENCE"), HasSubstr("SHA-256"),
            HasSubstr("4f57861c2ff1c87e92495789ee266e41a7dc79a038521d93a153be403b0b601f"),
            HasSubstr("http://download.tensorflow.org/models/object_detection/mask_rcnn_inception"),
            HasSubstr("not published; printed after the download"), HasSubstr("AGPL-3.0"),
            HasSubstr("Without a connection"), HasSubstr("yolo export model=yolov8n-seg.pt")));
  EXPECT_EQ(Models("list").out, result.out);
}

TEST_F(ModelsDownload, PinnedFileIsStoredAndVerified) {
  const std::string address = server_.Put("graph.pbtxt", kContents);
  const ProgramResult result =
      Download("mask-rcnn-inception-v2-graph --from " + address + " --sha256 " + kSha256);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr(kSha256), HasSubstr("\nverified\n"), HasSubstr(address),
                                HasSubstr("licence")));
  EXPECT_EQ(ReadFile(to() / "mask_rcnn_inception_v2_coco_2018_01_28.pbtxt"), kContents);
  EXPECT_EQ(CountFiles(), 1U);
}

TEST_F(ModelsDownload, ProgressIsShownUnlessQuiet) {
  const std::string address = server_.Put("graph.pbtxt", std::string(3'000'000, 'x'));
  const std::string arguments = "mask-rcnn-inception-v2-graph --from " + address;
  EXPECT_THAT(Download(arguments).err,
              AllOf(HasSubstr("[####################] 3.0 of 3.0 MB"), HasSubstr("MB/s")));
  EXPECT_THAT(Download(arguments + " --quiet").err, IsEmpty());
}

TEST_F(ModelsDownload, FileWithoutAPublishedSha256SaysSoAndPrintsIt) {
  const std::string address = server_.Put("graph.pbtxt", kContents);
  const ProgramResult result = Download("mask-rcnn-inception-v2-graph --from " + address);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out,
              AllOf(HasSubstr(kSha256), HasSubstr("not verified"), HasSubstr("--sha256")));
}

TEST_F(ModelsDownload, WrongFileIsThrownAwayAndTheOldOneStays) {
  const std::string address = server_.Put("other.onnx", "no network\n");
  const std::filesystem::path file = folder_.Write("models/MaskRCNN-12.onnx", "old");
  const ProgramResult result = Download("mask-rcnn-r50-fpn --quiet --from " + address);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(IsOneErrorLine(), HasSubstr("MaskRCNN-12.onnx: what came has the"),
                                HasSubstr("5bf940c124d9117f6fae350c4e0d46df180cbb01981832b35fdb")));
  EXPECT_EQ(ReadFile(file), "old");
  EXPECT_EQ(CountFiles(), 1U);
}

TEST_F(ModelsDownload, VerifiedFileIsNotFetchedAgain) {
  folder_.Write("models/mask_rcnn_inception_v2_coco_2018_01_28.pbtxt", kContents);
  const ProgramResult result =
      Download("mask-rcnn-inception-v2-graph --from http://127.0.0.1:1/none --sha256 " +
               std::string(kSha256));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("there already and verified"));
}

TEST_F(ModelsDownload, WithoutAConnectionTheErrorSaysWhatToDo) {
  const ProgramResult result =
      Download("mask-rcnn-inception-v2 --quiet --from http://127.0.0.1:1/net.tar.gz");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(IsOneErrorLine(), HasSubstr("http://127.0.0.1:1/net.tar.gz"),
                                HasSubstr("fetch it elsewhere, copy it to"),
                                HasSubstr("ofm-slam models verify")));
  EXPECT_EQ(CountFiles(), 0U);
}

TEST_F(ModelsDownload, MissingFileOnTheServerIsAnError) {
  const ProgramResult result =
      Download("mask-rcnn-inception-v2 --quiet --from " + server_.Address("none"));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(IsOneErrorLine(), HasSubstr("404")));
  EXPECT_EQ(CountFiles(), 0U);
}

TEST_F(ModelsDownload, OtherProtocolsAreRefused) {
  const std::string file = folder_.Write("local", kContents).string();
  const ProgramResult result = Download("mask-rcnn-inception-v2-graph --from file://" + file);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(IsOneErrorLine(), HasSubstr("cannot be fetched")));
}

TEST(Models, UnknownNameAndBadSha256AreErrors) {
  EXPECT_THAT(Models("download no-such-model").err,
              AllOf(IsOneErrorLine(), HasSubstr("'no-such-model'; ofm-slam models lists them")));
  EXPECT_THAT(Models("download mask-rcnn-inception-v2 --sha256 123").err,
              AllOf(IsOneErrorLine(), HasSubstr("'123' is no SHA-256")));
  EXPECT_THAT(Models("download").err, AllOf(IsOneErrorLine(), HasSubstr("NAME")));
}

TEST(Models, WhatNobodyPublishesSaysHowToMakeIt) {
  const ProgramResult result = Models("download yolov8n-seg-480x640");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(IsOneErrorLine(), HasSubstr("not published as a file"),
                                HasSubstr("yolo export model=yolov8n-seg.pt")));
}

TEST(Models, VerifyKnowsTheNetworksOfTheResults) {
  const auto file = std::filesystem::path(OFM_SHARED_DIR) / "models" / "yolov8n-seg_256x320.onnx";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is absent";
  const ProgramResult result = Models("verify '" + file.string() + "'");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("verified: yolov8n-seg-256x320"), HasSubstr("AGPL-3.0")));
}

TEST(Models, VerifyTellsAFileThatDidNotArriveWhole) {
  const TestFolder folder;
  const std::string file = folder.Write("MaskRCNN-12.onnx", kContents).string();
  const ProgramResult result = Models("verify " + file);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err,
              AllOf(IsOneErrorLine(), HasSubstr("is not mask-rcnn-r50-fpn or did not arrive whole"),
                    HasSubstr(kSha256)));
}

TEST(Models, VerifyComparesWithAPinnedSha256) {
  const TestFolder folder;
  const std::string file = folder.Write("my.onnx", kContents).string();
  EXPECT_THAT(Models("verify " + file).err,
              AllOf(IsOneErrorLine(), HasSubstr("none of the known models"), HasSubstr(kSha256)));
  std::string upper = kSha256;
  for (char& c : upper) c = static_cast<char>(std::toupper(c));
  EXPECT_THAT(Models("verify " + file + " --sha256 " + upper).out, HasSubstr("\nverified\n"));
  const ProgramResult wrong = Models("verify " + file + " --sha256 " + std::string(64, '0'));
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_THAT(wrong.err, AllOf(IsOneErrorLine(), HasSubstr(kSha256), Not(HasSubstr("known"))));
  EXPECT_THAT(Models("verify /no/such.onnx").err, HasSubstr("/no/such.onnx: does not exist"));
}

}  // namespace
}  // namespace ofm
