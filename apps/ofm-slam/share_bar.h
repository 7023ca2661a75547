// Shows the progress of one long step on the terminal.
#pragma once

#include <cstdint>
#include <string>

namespace ofm {

/// One line on stderr: "[####......]  40 % step". On a terminal it is drawn anew a few times a
/// second; elsewhere a line is printed now and then.
class ShareBar {
 public:
  explicit ShareBar(std::string step);
  ~ShareBar();
  ShareBar(const ShareBar&) = delete;
  ShareBar& operator=(const ShareBar&) = delete;

  /// `share` of the step, 0 to 1, is done.
  void OnShare(double share);

 private:
  std::string step_;
  bool terminal_, is_complete_ = false;
  std::int64_t drawn_ns_ = 0;
};

}  // namespace ofm
