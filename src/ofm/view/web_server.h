// A small web server for one page and what it is told while it is open.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "ofm/view/message_board.h"

namespace ofm {

struct WebServerOptions {
  std::string address = "127.0.0.1";  ///< of the interface to listen on; 0.0.0.0 = all
  std::uint16_t port = 0;             ///< 0 = any that is free
};

/// What a path shows. The bytes must outlive the server.
struct WebPage {
  std::string_view content_type, bytes;
};

/// Serves pages by GET and, at /stream, a web socket on which each viewer gets the message board:
/// all of it, then what is new. A viewer that reads slowly misses older states, and nobody waits
/// for it. Other sites' pages are not let in (the web socket's origin must be the server itself).
/// Has a thread of its own; the destructor sends what is on the board, but not for long, closes all
/// connections and joins it. All methods may be called from any thread.
class WebServer {
 public:
  /// Listens from now on. `pages` by path ("/"). Throws Error where the address cannot be had.
  WebServer(const WebServerOptions& options, std::map<std::string, WebPage> pages);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  std::uint16_t port() const;
  /// "http://127.0.0.1:8642/"
  std::string url() const;
  /// See MessageBoard::Put.
  void Put(std::string name, ViewMessage message);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace ofm
