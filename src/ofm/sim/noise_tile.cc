#include "ofm/sim/noise_tile.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace ofm {

cv::Mat MakeNoiseTile(RandomEngine& engine, int size_px, const NoiseGrain& grain) {
  cv::Mat sum = cv::Mat::zeros(size_px, size_px, CV_32FC1);
  double strength = 0.6;
  for (int octave = 0; octave < grain.octaves; ++octave, strength *= 0.5) {
    const int columns = std::min(size_px, grain.cells_x << octave);
    const int rows = std::min(size_px, grain.cells_y << octave);
    cv::Mat lattice(rows, columns, CV_32FC1);
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        lattice.at<float>(y, x) = static_cast<float>(UniformBetween(engine, -strength, strength));
      }
    }
    // Whole lattices around it, so that the edges meet.
    cv::Mat around, large;
    cv::copyMakeBorder(lattice, around, 2, 2, 2, 2, cv::BORDER_WRAP);
    const int cell_x = size_px / columns, cell_y = size_px / rows;
    cv::resize(around, large, {around.cols * cell_x, around.rows * cell_y}, 0, 0, cv::INTER_CUBIC);
    sum += large(cv::Rect(2 * cell_x, 2 * cell_y, size_px, size_px));
  }
  return sum;
}

cv::Mat ShadeTile(const cv::Scalar& bgr, const cv::Mat& noise, double amplitude) {
  cv::Mat tile(noise.size(), CV_8UC3);
  for (int y = 0; y < tile.rows; ++y) {
    for (int x = 0; x < tile.cols; ++x) {
      const double shade = amplitude * noise.at<float>(y, x);
      for (int c = 0; c < 3; ++c) {
        tile.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<uchar>(bgr[c] + shade);
      }
    }
  }
  return tile;
}

cv::Scalar VaryColor(RandomEngine& engine, const cv::Scalar& bgr, double spread) {
  const double shade = UniformBetween(engine, -spread, spread);
  return {bgr[0] + shade, bgr[1] + shade, bgr[2] + shade};
}

cv::Scalar RandomHue(RandomEngine& engine) {
  const double hue = UniformBetween(engine, 0, 180);
  const double saturation = UniformBetween(engine, 90, 210);
  const double value = UniformBetween(engine, 70, 220);
  cv::Mat pixel(1, 1, CV_8UC3, cv::Scalar(hue, saturation, value));
  cv::cvtColor(pixel, pixel, cv::COLOR_HSV2BGR);
  const cv::Vec3b bgr = pixel.at<cv::Vec3b>(0, 0);
  return {double(bgr[0]), double(bgr[1]), double(bgr[2])};
}

}  // namespace ofm
