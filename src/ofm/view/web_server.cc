#include "ofm/view/web_server.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <exception>
#include <thread>
#include <utility>

#include "ofm/base/error.h"
#include "ofm/view/web_session.h"

namespace ofm {
namespace {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;

/// For viewers to take the last messages.
constexpr std::chrono::milliseconds kGoodbye(1000);

Tcp::acceptor Listen(asio::io_context& context, const WebServerOptions& options) {
  boost::system::error_code error;
  const auto address = asio::ip::make_address(options.address, error);
  if (error) {
    throw Error(
        fmt::format("\"{}\" is no address to listen on; 127.0.0.1 is this machine alone, "
                    "0.0.0.0 lets others in",
                    options.address));
  }
  try {
    return {context, Tcp::endpoint(address, options.port)};
  } catch (const boost::system::system_error& failure) {
    throw Error(
        fmt::format("the view cannot listen on {}:{}: {}; choose another port, 0 takes any "
                    "that is free",
                    options.address, options.port, failure.code().message()));
  }
}

}  // namespace

class WebServer::Implementation {
 public:
  Implementation(const WebServerOptions& options, std::map<std::string, WebPage> pages)
      : acceptor_(Listen(context_, options)), goodbye_(context_) {
    hub_.pages = std::move(pages);
    Accept();
    thread_ = std::jthread([this] { Serve(); });
  }
  ~Implementation() {
    asio::post(context_, [this] { Finish(); });
    thread_.join();
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  Tcp::endpoint endpoint() const { return endpoint_; }

  void Put(std::string name, ViewMessage message) {
    asio::post(context_, [this, name = std::move(name), message = std::move(message)] {
      hub_.board.Put(name, message);
      for (const auto& viewer : hub_.viewers) viewer->Wake();
    });
  }

 private:
  void Accept() {
    acceptor_.async_accept([this](boost::system::error_code error, Tcp::socket socket) {
      if (!acceptor_.is_open()) return;
      if (!error) ServeConnection(std::move(socket), hub_);
      Accept();
    });
  }

  /// The thread ends when the last viewer has left, or after a while.
  void Finish() {
    acceptor_.close();
    hub_.on_leave = [this] { EndWhenAlone(); };
    for (const auto& viewer : hub_.viewers) viewer->Finish();
    goodbye_.expires_after(kGoodbye);
    goodbye_.async_wait([this](boost::system::error_code) { context_.stop(); });
    EndWhenAlone();
  }
  void EndWhenAlone() {
    if (hub_.viewers.empty()) context_.stop();
  }
  /// A view that fails is no reason for the run to.
  void Serve() {
    try {
      context_.run();
    } catch (const std::exception& error) {
      spdlog::warn("the live view ended: {}", error.what());
    }
  }

  asio::io_context context_;
  Tcp::acceptor acceptor_;
  Tcp::endpoint endpoint_ = acceptor_.local_endpoint();
  asio::steady_timer goodbye_;
  ViewerHub hub_;
  std::jthread thread_;
};

WebServer::WebServer(const WebServerOptions& options, std::map<std::string, WebPage> pages)
    : implementation_(std::make_unique<Implementation>(options, std::move(pages))) {}

WebServer::~WebServer() = default;

std::uint16_t WebServer::port() const { return implementation_->endpoint().port(); }

std::string WebServer::url() const {
  const asio::ip::address address = implementation_->endpoint().address();
  const std::string host = address.is_unspecified() ? "localhost"
                           : address.is_v6()        ? "[" + address.to_string() + "]"
                                                    : address.to_string();
  return fmt::format("http://{}:{}/", host, port());
}

void WebServer::Put(std::string name, ViewMessage message) {
  implementation_->Put(std::move(name), std::move(message));
}

}  // namespace ofm
