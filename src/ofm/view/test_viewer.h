// A viewer without a browser. Tests only.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <cstdint>
#include <optional>
#include <string>

namespace ofm::test {

/// The answer to a request for a path.
inline boost::beast::http::response<boost::beast::http::string_body> Request(
    std::uint16_t port, const std::string& path,
    boost::beast::http::verb verb = boost::beast::http::verb::get) {
  namespace http = boost::beast::http;
  boost::asio::io_context context;
  boost::beast::tcp_stream stream(context);
  stream.connect({boost::asio::ip::make_address("127.0.0.1"), port});
  http::request<http::empty_body> request(verb, path, 11);
  request.set(http::field::host, "127.0.0.1");
  http::write(stream, request);
  boost::beast::flat_buffer buffer;
  http::response_parser<http::string_body> parser;
  parser.skip(verb == http::verb::head);
  http::read(stream, buffer, parser);
  return parser.release();
}

/// At the web socket. Throws boost::system::system_error where it is not let in.
class Viewer {
 public:
  explicit Viewer(std::uint16_t port, const std::string& origin = "") : socket_(context_) {
    const std::string host = "127.0.0.1:" + std::to_string(port);
    boost::beast::get_lowest_layer(socket_).connect(
        {boost::asio::ip::make_address("127.0.0.1"), port});
    if (!origin.empty()) {
      socket_.set_option(boost::beast::websocket::stream_base::decorator(
          [origin](boost::beast::websocket::request_type& request) {
            request.set(boost::beast::http::field::origin, origin);
          }));
    }
    socket_.handshake(host, "/stream");
  }

  /// The next message; empty where the server has closed.
  std::optional<std::string> Read() {
    boost::beast::flat_buffer buffer;
    boost::beast::error_code error;
    socket_.read(buffer, error);
    if (error) return {};
    return boost::beast::buffers_to_string(buffer.data());
  }
  bool got_text() const { return socket_.got_text(); }

 private:
  boost::asio::io_context context_;
  boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
};

}  // namespace ofm::test
