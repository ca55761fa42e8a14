// SPDX-License-Identifier: BSD-3-Clause
// An SVG document as a PNG file, by librsvg and cairo.
#include "SvgDrawing.h"

#include <cairo.h>
#include <librsvg/rsvg.h>

#include <cmath>
#include <memory>
#include <stdexcept>

namespace nephoscope
{
namespace charts
{
void writePng(const std::string& svg, const std::string& path, double scale)
{
  GError* error = nullptr;
  const std::unique_ptr<RsvgHandle, void (*)(gpointer)> handle(
    rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error),
    g_object_unref);
  double width = 0;
  double height = 0;
  if (!handle || !rsvg_handle_get_intrinsic_size_in_pixels(handle.get(), &width, &height))
  {
    const std::string why = error ? error->message : "it has no size";
    g_clear_error(&error);
    throw std::runtime_error("cannot draw " + path + ": " + why);
  }
  const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(
    cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::lround(width * scale)),
      static_cast<int>(std::lround(height * scale))),
    cairo_surface_destroy);
  const std::unique_ptr<cairo_t, void (*)(cairo_t*)> context(
    cairo_create(surface.get()), cairo_destroy);
  const RsvgRectangle page{ 0, 0, width * scale, height * scale };
  const bool drawn = rsvg_handle_render_document(handle.get(), context.get(), &page, &error) != 0;
  g_clear_error(&error);
  if (!drawn || cairo_surface_write_to_png(surface.get(), path.c_str()) != CAIRO_STATUS_SUCCESS)
  {
    throw std::runtime_error("cannot write " + path + "; is the folder there and writable?");
  }
}
}
}
