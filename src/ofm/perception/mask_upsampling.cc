#include "ofm/perception/mask_upsampling.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace ofm {
namespace {

/// Bit i is set where a cell or pixel is of the i-th mask.
using Members = std::uint32_t;
constexpr std::size_t kMasksAtOnce = 31;
/// Of a cell that is not of the same masks as all of its neighbours.
constexpr Members kDoubtful = Members{1} << kMasksAtOnce;

/// CV_32SC1 of Members per cell.
cv::Mat FindMembers(std::span<const cv::Mat> masks) {
  cv::Mat members(masks[0].size(), CV_32SC1, cv::Scalar(0));
  for (std::size_t i = 0; i < masks.size(); ++i) {
    const Members bit = Members{1} << i;
    for (int y = 0; y < members.rows; ++y) {
      const std::uint8_t* mask = masks[i].ptr(y);
      auto* out = members.ptr<Members>(y);
      for (int x = 0; x < members.cols; ++x) out[x] |= mask[x] != 0 ? bit : 0;
    }
  }
  return members;
}

/// `members` with kDoubtful where a cell disagrees with one of the eight around it.
cv::Mat MarkDoubtful(const cv::Mat& members) {
  cv::Mat marked = members.clone();
  const cv::Rect lattice({}, members.size());
  const cv::Point kHalfOfTheSides[] = {{1, 0}, {-1, 1}, {0, 1}, {1, 1}};
  for (int y = 0; y < members.rows; ++y) {
    for (int x = 0; x < members.cols; ++x) {
      const Members own = members.ptr<Members>(y)[x];
      for (const cv::Point side : kHalfOfTheSides) {
        const cv::Point other = cv::Point(x, y) + side;
        if (!lattice.contains(other) || members.ptr<Members>(other.y)[other.x] == own) continue;
        marked.ptr<Members>(y)[x] |= kDoubtful;
        marked.ptr<Members>(other.y)[other.x] |= kDoubtful;
      }
    }
  }
  return marked;
}

/// Cells with a rim of one cell around them, so that each has nine neighbours.
class Neighbourhoods {
 public:
  Neighbourhoods(const cv::Mat& members, const cv::Mat& cell_depth_m) {
    constexpr int kRim = cv::BORDER_CONSTANT | cv::BORDER_ISOLATED;
    cv::copyMakeBorder(members, members_, 1, 1, 1, 1, kRim, 0);
    cv::copyMakeBorder(cell_depth_m, depth_m_, 1, 1, 1, 1, kRim, 0);
    depth_m_.setTo(std::numeric_limits<float>::infinity(), ~(depth_m_ > 0));  // is like none
  }

  /// What the cell of most similar depth among the nine around (x, y) is of; that cell itself where
  /// none has a depth.
  Members FollowDepth(int x, int y, float depth_m) const {
    Members answer = members_.ptr<Members>(y + 1)[x + 1];
    float least = std::numeric_limits<float>::max();
    for (int row = y; row < y + 3; ++row) {
      const float* depths = depth_m_.ptr<float>(row) + x;
      const Members* says = members_.ptr<Members>(row) + x;
      for (int i = 0; i < 3; ++i) {
        const float difference = std::abs(depths[i] - depth_m);
        // A select without a branch: no one could predict it, and this is a hot loop.
        const Members closer = difference < least ? ~Members{0} : 0;
        least = std::min(difference, least);
        answer ^= (answer ^ says[i]) & closer;
      }
    }
    return answer;
  }

 private:
  cv::Mat members_, depth_m_;
};

/// Sets the pixels [begin, end) of row `y` in the masks that they are of.
void WriteRun(Members members, int y, int begin, int end, std::span<cv::Mat> masks) {
  for (; members != 0; members &= members - 1) {
    std::uint8_t* row = masks[static_cast<std::size_t>(std::countr_zero(members))].ptr(y);
    std::memset(row + begin, 255, static_cast<std::size_t>(end - begin));
  }
}

/// Pixels outside of which no cell is of a mask, and none is in doubt.
cv::Rect FindArea(const IdealLattice& cells, const cv::Mat& members) {
  cv::Rect around = cv::boundingRect(members != 0);
  if (around.empty()) return {};
  around = (around - cv::Point(1, 1) + cv::Size(2, 2)) & cv::Rect({}, members.size());
  return cells.ImageRect(around);
}

/// At most kMasksAtOnce of them.
void Upsample(const IdealLattice& cells, std::span<const cv::Mat> masks,
              const cv::Mat& cell_depth_m, const cv::Mat& depth_m, std::span<cv::Mat> upsampled) {
  const cv::Mat members = FindMembers(masks);
  const cv::Rect area = FindArea(cells, members);
  if (area.empty()) return;
  const cv::Mat marked = MarkDoubtful(members);
  const Neighbourhoods neighbourhoods(members, cell_depth_m);
  for (int y = area.y; y < area.br().y; ++y) {
    const auto* points = cells.nearest_points().ptr<cv::Vec2s>(y);
    const float* depth = depth_m.ptr<float>(y);
    Members run = 0;
    int begin = area.x;
    for (int x = area.x; x < area.br().x; ++x) {
      const int column = points[x][0], row = points[x][1];
      Members of = marked.ptr<Members>(row)[column];
      if ((of & kDoubtful) != 0) {
        of = depth[x] > 0 ? neighbourhoods.FollowDepth(column, row, depth[x]) : of & ~kDoubtful;
      }
      if (of == run) continue;
      WriteRun(run, y, begin, x, upsampled);
      run = of;
      begin = x;
    }
    WriteRun(run, y, begin, area.br().x, upsampled);
  }
}

}  // namespace

std::vector<cv::Mat> UpsampleMasks(const IdealLattice& cells, std::span<const cv::Mat> masks,
                                   const cv::Mat& cell_depth_m, const cv::Mat& depth_m) {
  std::vector<cv::Mat> upsampled;
  upsampled.reserve(masks.size());
  for (std::size_t i = 0; i < masks.size(); ++i) {
    upsampled.push_back(cv::Mat::zeros(cells.nearest_points().size(), CV_8UC1));
  }
  for (std::size_t first = 0; first < masks.size(); first += kMasksAtOnce) {
    const std::size_t count = std::min(kMasksAtOnce, masks.size() - first);
    Upsample(cells, masks.subspan(first, count), cell_depth_m, depth_m,
             std::span(upsampled).subspan(first, count));
  }
  return upsampled;
}

cv::Mat UpsampleMask(const IdealLattice& cells, const cv::Mat& moving, const cv::Mat& cell_depth_m,
                     const cv::Mat& depth_m) {
  return UpsampleMasks(cells, {&moving, 1}, cell_depth_m, depth_m)[0];
}

}  // namespace ofm
