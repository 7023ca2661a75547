#include "ofm/view/web_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "ofm/base/error.h"
#include "ofm/io/test_folder.h"
#include "ofm/view/test_viewer.h"

namespace ofm {
namespace {

using test::Viewer;
using testing::HasSubstr;
namespace http = boost::beast::http;

const std::map<std::string, WebPage> kPages = {{"/", {"text/html", "<p>hello</p>"}}};

ViewMessage Text(const std::string& text) {
  return {std::make_shared<const std::string>(text), true};
}
ViewMessage Binary(const std::string& bytes) {
  return {std::make_shared<const std::string>(bytes), false};
}

TEST(WebServer, ServesItsPages) {
  const WebServer server({}, kPages);
  for (const char* path : {"/", "/?a=b"}) {
    const auto response = test::Request(server.port(), path);
    EXPECT_EQ(response.result(), http::status::ok);
    EXPECT_EQ(response[http::field::content_type], "text/html");
    EXPECT_EQ(response.body(), "<p>hello</p>");
  }
}

TEST(WebServer, OtherRequestsAreRefused) {
  const WebServer server({}, kPages);
  EXPECT_EQ(test::Request(server.port(), "/etc/passwd").result(), http::status::not_found);
  EXPECT_EQ(test::Request(server.port(), "/", http::verb::post).result(),
            http::status::method_not_allowed);
  const auto head = test::Request(server.port(), "/", http::verb::head);
  EXPECT_EQ(head.result(), http::status::ok);
  EXPECT_EQ(head.body(), "");
}

TEST(WebServer, TellsWhereItIs) {
  const WebServer server({}, kPages);
  EXPECT_EQ(server.url(), "http://127.0.0.1:" + std::to_string(server.port()) + "/");
}

TEST(WebServer, AViewerGetsWhatIsThereAndWhatComes) {
  WebServer server({}, kPages);
  server.Put("a", Text("first"));
  Viewer viewer(server.port());
  EXPECT_EQ(viewer.Read(), "first");
  EXPECT_TRUE(viewer.got_text());
  server.Put("b", Binary({'\0', 'x'}));
  EXPECT_EQ(viewer.Read(), std::string({'\0', 'x'}));
  EXPECT_FALSE(viewer.got_text());
}

TEST(WebServer, AViewerThatDoesNotReadMissesOldStatesAndHoldsNobodyUp) {
  WebServer server({}, kPages);
  Viewer slow(server.port()), quick(server.port());
  constexpr int kMessages = 200;
  const std::string padding(1'000'000, '.');  // more than a connection takes without being read
  for (int i = 0; i < kMessages; ++i) server.Put("state", Text(std::to_string(i) + padding));
  const std::string newest = std::to_string(kMessages - 1) + padding;
  while (quick.Read() != newest) {
  }
  int messages = 1;
  while (slow.Read() != newest) ++messages;
  EXPECT_LT(messages, kMessages);
}

TEST(WebServer, TheEndIsToldBeforeItCloses) {
  auto server = std::make_unique<WebServer>(WebServerOptions{}, kPages);
  Viewer viewer(server->port());
  server->Put("a", Text("1"));
  EXPECT_EQ(viewer.Read(), "1");
  server->Put("end", Text("bye"));
  std::jthread closing([&] { server.reset(); });
  EXPECT_EQ(viewer.Read(), "bye");
  EXPECT_EQ(viewer.Read(), std::nullopt);
}

TEST(WebServer, AViewerThatNeverReadsDoesNotHoldUpTheEnd) {
  auto server = std::make_unique<WebServer>(WebServerOptions{}, kPages);
  const Viewer viewer(server->port());
  server->Put("a", Text(std::string(50'000'000, '.')));
  server.reset();
}

TEST(WebServer, PagesOfOtherSitesAreNotLetIn) {
  const WebServer server({}, kPages);
  EXPECT_THROW(Viewer(server.port(), "http://elsewhere.example"), boost::system::system_error);
  EXPECT_NO_THROW(Viewer(server.port(), "http://127.0.0.1:" + std::to_string(server.port())));
}

TEST(WebServer, APortThatIsTakenIsAnError) {
  const WebServer server({}, kPages);
  EXPECT_THAT(ErrorOf([&] {
                WebServer({"127.0.0.1", server.port()}, kPages);
              }),
              testing::AllOf(HasSubstr(std::to_string(server.port())), HasSubstr("another port")));
}

TEST(WebServer, WhatIsNoAddressIsAnError) {
  EXPECT_THAT(ErrorOf([] { WebServer({"my machine", 0}, kPages); }), HasSubstr("\"my machine\""));
}

}  // namespace
}  // namespace ofm
