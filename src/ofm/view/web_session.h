// One connection of a viewer.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "ofm/view/web_server.h"

namespace ofm {

class ViewerSession;

/// What all connections of a server share. Lives as long as its thread.
struct ViewerHub {
  std::map<std::string, WebPage> pages;
  MessageBoard board;
  std::set<std::shared_ptr<ViewerSession>> viewers;  ///< with an open web socket
  std::function<void()> on_leave = [] {};            ///< after one of them has gone
};

/// A viewer at the web socket.
class ViewerSession {
 public:
  virtual ~ViewerSession() = default;
  /// Sends what is new on the board, unless it is still sending.
  virtual void Wake() = 0;
  /// Sends what is new on the board, then says goodbye.
  virtual void Finish() = 0;
};

/// Answers one request: a page, an error, or the way to the web socket.
void ServeConnection(boost::asio::ip::tcp::socket socket, ViewerHub& hub);

}  // namespace ofm
