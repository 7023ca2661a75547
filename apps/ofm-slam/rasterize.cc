#include "rasterize.h"

#include <cairo/cairo.h>
#include <fmt/format.h>
#include <librsvg/rsvg.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "ofm/base/error.h"

namespace ofm {
namespace {

struct Unref {
  void operator()(RsvgHandle* handle) const { g_object_unref(handle); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};

[[noreturn]] void Fail(GError* error) {
  const std::string reason = error != nullptr ? error->message : "unknown reason";
  g_clear_error(&error);
  throw Error(fmt::format("a plot cannot be drawn as PNG ({}); write .svg instead", reason));
}

cairo_status_t Append(void* text, const unsigned char* bytes, unsigned length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

std::string RasterizeSvg(const std::string& svg, int width_px) {
  GError* error = nullptr;
  const std::unique_ptr<RsvgHandle, Unref> handle(rsvg_handle_new_from_data(
      reinterpret_cast<const unsigned char*>(svg.data()), svg.size(), &error));
  if (!handle) Fail(error);
  double width = 0, height = 0;
  if (rsvg_handle_get_intrinsic_size_in_pixels(handle.get(), &width, &height) == 0 || width <= 0) {
    Fail(nullptr);
  }
  const double height_px = std::ceil(width_px * height / width);
  const std::unique_ptr<cairo_surface_t, Unref> surface(cairo_image_surface_create(
      CAIRO_FORMAT_RGB24, width_px, static_cast<int>(std::min(height_px, 1e6))));
  const std::unique_ptr<cairo_t, Unref> context(cairo_create(surface.get()));
  const RsvgRectangle viewport{0, 0, static_cast<double>(width_px), height_px};
  if (rsvg_handle_render_document(handle.get(), context.get(), &viewport, &error) == 0) {
    Fail(error);
  }
  std::string png;
  if (cairo_surface_write_to_png_stream(surface.get(), &Append, &png) != CAIRO_STATUS_SUCCESS) {
    Fail(nullptr);
  }
  return png;
}

}  // namespace ofm
