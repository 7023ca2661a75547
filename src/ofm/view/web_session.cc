#include "ofm/view/web_session.h"

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <string_view>
#include <utility>

namespace ofm {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
using Socket = boost::asio::ip::tcp::socket;
using Request = http::request<http::empty_body>;

/// For a request to come, or an answer to be taken.
constexpr std::chrono::seconds kPatience(30);
constexpr std::string_view kStreamPath = "/stream";

std::string_view View(beast::string_view text) { return {text.data(), text.size()}; }

class WebSocketSession : public ViewerSession,
                         public std::enable_shared_from_this<WebSocketSession> {
 public:
  WebSocketSession(beast::tcp_stream stream, ViewerHub& hub)
      : socket_(std::move(stream)), hub_(hub) {}

  void Accept(const Request& request) {
    beast::get_lowest_layer(socket_).expires_never();
    socket_.set_option(beast::websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (error) return;
      self->hub_.viewers.insert(self);
      self->Listen();
      self->Wake();
    });
  }

  void Wake() override {
    if (sending_) return;
    const MessageBoard::Post* post = hub_.board.Next(seen_);
    if (post == nullptr) {
      if (finishing_) Close();
      return;
    }
    sending_ = true;
    seen_ = post->number;
    current_ = post->message.bytes;
    socket_.text(post->message.is_text);
    socket_.async_write(boost::asio::buffer(*current_),
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                          self->sending_ = false;
                          if (error) return self->Leave();
                          self->Wake();
                        });
  }

  void Finish() override {
    finishing_ = true;
    Wake();
  }

 private:
  /// Viewers have nothing to say; reading tells when they go.
  void Listen() {
    socket_.async_read(heard_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return self->Leave();
      self->heard_.clear();
      self->Listen();
    });
  }
  void Close() {
    if (std::exchange(closing_, true)) return;
    socket_.async_close(beast::websocket::close_code::going_away,
                        [self = shared_from_this()](beast::error_code) { self->Leave(); });
  }
  void Leave() {
    if (hub_.viewers.erase(shared_from_this()) > 0) hub_.on_leave();
  }

  beast::websocket::stream<beast::tcp_stream> socket_;
  ViewerHub& hub_;
  beast::flat_buffer heard_;
  std::shared_ptr<const std::string> current_;  // on its way
  std::uint64_t seen_ = 0;
  bool sending_ = false, finishing_ = false, closing_ = false;
};

/// Reads one request and answers it.
class HttpSession : public std::enable_shared_from_this<HttpSession> {
 public:
  HttpSession(Socket socket, ViewerHub& hub) : stream_(std::move(socket)), hub_(hub) {}

  void Read() {
    stream_.expires_after(kPatience);
    http::async_read(stream_, buffer_, request_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                       if (!error) self->Answer();
                     });
  }

 private:
  void Answer() {
    const std::string_view path = View(request_.target());
    const auto page = hub_.pages.find(std::string(path.substr(0, path.find('?'))));
    if (beast::websocket::is_upgrade(request_) && path == kStreamPath) {
      if (!IsOwnOrigin()) return Send(http::status::forbidden, {"text/plain", "another origin\n"});
      std::make_shared<WebSocketSession>(std::move(stream_), hub_)->Accept(request_);
    } else if (request_.method() != http::verb::get && request_.method() != http::verb::head) {
      Send(http::status::method_not_allowed, {"text/plain", "only GET is known\n"});
    } else if (page == hub_.pages.end()) {
      Send(http::status::not_found, {"text/plain", "there is no such page\n"});
    } else {
      Send(http::status::ok, page->second);
    }
  }

  /// A page of another site may not look on. Programs name no origin.
  bool IsOwnOrigin() const {
    const std::string_view origin = View(request_[http::field::origin]);
    return origin.empty() || origin == "http://" + std::string(View(request_[http::field::host]));
  }

  void Send(http::status status, const WebPage& page) {
    response_.result(status);
    response_.version(request_.version());
    response_.set(http::field::content_type,
                  beast::string_view(page.content_type.data(), page.content_type.size()));
    response_.set(http::field::cache_control, "no-store");
    response_.set("X-Content-Type-Options", "nosniff");
    if (request_.method() != http::verb::head) {
      response_.body() = {page.bytes.data(), page.bytes.size()};
    }
    response_.prepare_payload();
    response_.keep_alive(false);
    http::async_write(stream_, response_,
                      [self = shared_from_this()](beast::error_code, std::size_t) {
                        beast::error_code ignored;
                        self->stream_.socket().shutdown(Socket::shutdown_send, ignored);
                      });
  }

  beast::tcp_stream stream_;
  ViewerHub& hub_;
  beast::flat_buffer buffer_;
  Request request_;
  http::response<http::span_body<const char>> response_;
};

}  // namespace

void ServeConnection(Socket socket, ViewerHub& hub) {
  std::make_shared<HttpSession>(std::move(socket), hub)->Read();
}

}  // namespace ofm
