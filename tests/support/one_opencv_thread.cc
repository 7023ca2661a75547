// Linked into every test program. As in the program itself, a stage has one thread and OpenCV
// starts none of its own; the thread sanitizer could not see how those agree with one another.
#include <opencv2/core/utility.hpp>

namespace {

[[maybe_unused]] const bool kIsSet = [] {
  cv::setNumThreads(1);
  return true;
}();

}  // namespace
