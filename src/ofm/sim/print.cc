#include "ofm/sim/print.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "ofm/base/check.h"
#include "ofm/sim/noise_tile.h"

namespace ofm {
namespace {

constexpr int kTile_px = 512;

/// Draws on an image of the print's shape.
class Printer {
 public:
  Printer(const cv::Size& size, std::uint64_t seed)
      : image_(size, CV_8UC3), engine_(MakeRandomEngine(seed, 0)) {}

  cv::Mat Paint(Print print) {
    switch (print) {
      case Print::kPoster:
        PaintPoster();
        break;
      case Print::kDocument:
        PaintDocument();
        break;
      case Print::kScreen:
        PaintScreen();
        break;
      case Print::kKeyboard:
        PaintKeyboard();
        break;
      case Print::kDoor:
        PaintDoor();
        break;
      case Print::kWindow:
        PaintWindow();
        break;
    }
    return image_;
  }

 private:
  int Draw(int low, int high) {
    return low + static_cast<int>(UniformIndex(engine_, static_cast<std::uint32_t>(high - low)));
  }
  cv::Rect Within(const cv::Rect& rect) const { return rect & cv::Rect({0, 0}, image_.size()); }
  void Fill(const cv::Rect& rect, const cv::Scalar& bgr) {
    cv::rectangle(image_, Within(rect), bgr, cv::FILLED);
  }

  /// From `top` to `bottom` colour.
  void FillGradient(const cv::Rect& area, const cv::Scalar& top, const cv::Scalar& bottom) {
    const cv::Rect rect = Within(area);
    for (int y = 0; y < rect.height; ++y) {
      const double ratio = static_cast<double>(y) / rect.height;
      Fill({rect.x, rect.y + y, rect.width, 1}, top * (1 - ratio) + bottom * ratio);
    }
  }

  /// Words of bars.
  void WriteText(const cv::Rect& area, int line_px, const cv::Scalar& ink) {
    for (int y = area.y; y + line_px <= area.y + area.height; y += line_px) {
      const int end = area.x + area.width - (Draw(0, 3) == 0 ? area.width / 2 : 0);
      for (int x = area.x; x < end;) {
        const int width = std::min(Draw(line_px / 2, 4 * line_px), end - x);
        Fill({x, y + line_px / 4, width, std::max(1, line_px / 2)}, ink);
        x += width + line_px / 2;
      }
    }
  }

  void PaintPoster() {
    const int w = image_.cols, h = image_.rows;
    FillGradient({0, 0, w, h}, RandomHue(engine_), cv::Scalar(225, 230, 235));
    for (int i = 0; i < 14; ++i) {
      const cv::Point at(Draw(0, w), Draw(h / 3, h));
      const int size = Draw(h / 16, h / 4);
      if (i % 3 == 0) {
        cv::circle(image_, at, size / 2, RandomHue(engine_), cv::FILLED, cv::LINE_AA);
      } else {
        const std::vector<cv::Point> hill = {at, at + cv::Point(size, size),
                                             at + cv::Point(-size, size)};
        cv::fillConvexPoly(image_, hill, RandomHue(engine_) * 0.8, cv::LINE_AA);
      }
    }
    Fill({0, h - h / 6, w, h / 6}, cv::Scalar(235, 238, 240));
    WriteText({w / 12, h - h / 7, w - w / 6, h / 9}, std::max(8, h / 20), cv::Scalar(40, 35, 30));
    cv::rectangle(image_, cv::Rect(0, 0, w, h), cv::Scalar(35, 35, 40), std::max(4, w / 30));
  }

  void PaintDocument() {
    const int w = image_.cols, h = image_.rows;
    image_.setTo(cv::Scalar(232, 236, 238));
    WriteText({w / 10, h / 16, w - w / 5, h / 10}, h / 12, cv::Scalar(60, 40, 30));
    WriteText({w / 10, h / 4, w - w / 5, h / 3}, std::max(6, h / 32), cv::Scalar(70, 70, 70));
    FillGradient({w / 10, h - h / 3, w / 2, h / 4}, RandomHue(engine_), RandomHue(engine_));
  }

  void PaintScreen() {
    const int w = image_.cols, h = image_.rows;
    FillGradient({0, 0, w, h}, cv::Scalar(120, 70, 30), cv::Scalar(60, 30, 40));
    for (int i = 0; i < 2; ++i) {
      const cv::Rect window(Draw(0, w / 3) + i * w / 4, Draw(h / 20, h / 4), w / 2, h * 3 / 5);
      const bool dark = Draw(0, 2) == 0;
      Fill(window, dark ? cv::Scalar(45, 40, 38) : cv::Scalar(240, 240, 240));
      Fill({window.x, window.y, window.width, h / 18}, cv::Scalar(190, 140, 80));
      const cv::Rect text(window.x + 10, window.y + h / 14, window.width - 20,
                          window.height - h / 8);
      WriteText(text, h / 34 + 4, dark ? cv::Scalar(120, 200, 150) : cv::Scalar(60, 60, 60));
    }
    Fill({0, h - h / 18, w, h / 18}, cv::Scalar(50, 45, 40));
  }

  void PaintKeyboard() {
    const int w = image_.cols, h = image_.rows;
    image_.setTo(cv::Scalar(45, 45, 48));
    const int key = std::max(6, h / 6);
    for (int y = key / 2; y + key < h; y += key) {
      for (int x = key / 2; x + key < w; x += key) {
        Fill({x, y, key - 3, key - 3}, cv::Scalar(85, 85, 90));
        Fill({x + key / 4, y + key / 4, key / 3, key / 5}, cv::Scalar(210, 210, 210));
      }
    }
  }

  void PaintDoor() {
    const int w = image_.cols, h = image_.rows;
    const cv::Scalar wood = VaryColor(engine_, {95, 130, 165}, 30);
    cv::Mat noise;
    cv::resize(MakeNoiseTile(engine_, kTile_px, {32, 4, 4}), noise, image_.size());
    ShadeTile(wood, noise, 18).copyTo(image_);
    for (const double top : {0.08, 0.55}) {
      const cv::Rect panel(w / 6, static_cast<int>(top * h), w * 2 / 3, static_cast<int>(0.37 * h));
      cv::rectangle(image_, panel, wood * 0.6, std::max(2, w / 40));
    }
    Fill({w / 3, static_cast<int>(0.2 * h), w / 3, h / 12}, cv::Scalar(230, 230, 230));
    WriteText({w / 3 + 5, static_cast<int>(0.21 * h), w / 3 - 10, h / 14}, h / 36,
              cv::Scalar(40, 40, 40));
  }

  void PaintWindow() {
    const int w = image_.cols, h = image_.rows;
    FillGradient({0, 0, w, h}, cv::Scalar(245, 215, 170), cv::Scalar(245, 240, 230));
    for (int x = 0; x < w; x += Draw(w / 12, w / 6)) {
      const cv::Rect house(x, h - Draw(h / 4, h * 2 / 3), w / 7, h);
      Fill(house, VaryColor(engine_, {150, 165, 180}, 40));
      for (int y = house.y + 12; y < h; y += 26) {
        for (int u = house.x + 8; u + 10 < house.x + house.width; u += 22) {
          Fill({u, y, 10, 14}, cv::Scalar(110, 100, 90));
        }
      }
    }
    const cv::Scalar frame(225, 228, 230);
    cv::rectangle(image_, cv::Rect(0, 0, w, h), frame, w / 14);
    Fill({w / 2 - w / 60, 0, w / 30, h}, frame);
    Fill({0, h / 3, w, h / 40}, frame);
  }

  cv::Mat image_;
  RandomEngine engine_;
};

}  // namespace

Texture MakePrint(Print print, double width_m, double height_m, std::uint64_t seed) {
  OFM_CHECK(width_m > 0 && height_m > 0);
  const double side_m = std::max(width_m, height_m);
  const cv::Size size(std::max(16, cvRound(kTile_px * width_m / side_m)),
                      std::max(16, cvRound(kTile_px * height_m / side_m)));
  cv::Mat image = Printer(size, seed).Paint(print);
  cv::flip(image, image, 0);  // rows go up with v
  cv::Mat tile;
  cv::copyMakeBorder(image, tile, 0, kTile_px - size.height, 0, kTile_px - size.width,
                     cv::BORDER_REPLICATE);
  // The middle of the image to the corner of the tile, which is at (0, 0).
  cv::Mat wrapped;
  cv::repeat(tile, 2, 2, wrapped);
  const cv::Rect from(size.width / 2, size.height / 2, kTile_px, kTile_px);
  return {wrapped(from).clone(), side_m / kTile_px};
}

}  // namespace ofm
