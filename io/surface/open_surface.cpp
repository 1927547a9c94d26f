// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The table of the formats of surfaces.
#include "io/surface/open_surface.h"

#include <array>

#include "io/file/errors.h"
#include "io/surface/obj_sink.h"
#include "io/surface/ply_sink.h"
#include "io/surface/stl_sink.h"
#include "io/surface/vtp_sink.h"

namespace mw::io {
namespace {

struct SurfaceFormat {
  const char* extension;
  std::unique_ptr<SurfaceSink> (*open)(const std::filesystem::path&);
  SurfaceTraits traits{};
};

template <class Sink>
std::unique_ptr<SurfaceSink> open(const std::filesystem::path& path) {
  return std::make_unique<Sink>(path);
}

constexpr std::array kFormats{
    SurfaceFormat{".stl", &open<StlSink>, {.joined = Joined::kByPlace, .is_printed = true}},
    SurfaceFormat{".ply", &open<PlySink>},
    SurfaceFormat{".obj", &open<ObjSink>, {.is_printed = true}},
    SurfaceFormat{".vtp", &open<VtpSink>},
};

const SurfaceFormat* find_format(const std::filesystem::path& path) {
  for (const SurfaceFormat& format : kFormats) {
    if (path.extension() == format.extension) return &format;
  }
  return nullptr;
}

}  // namespace

std::string surface_extensions() {
  std::string out;
  for (const SurfaceFormat& format : kFormats) {
    out += (out.empty() ? "" : ", ") + text(format.extension);
  }
  return out;
}

bool is_surface_path(const std::filesystem::path& path) {
  return find_format(path) != nullptr;
}

SurfaceTraits surface_traits(const std::filesystem::path& path) {
  return find_format(path)->traits;
}

std::unique_ptr<SurfaceSink> open_surface_sink(const std::filesystem::path& path) {
  if (const SurfaceFormat* format = find_format(path)) return format->open(path);
  fail_usage(path.string(), ": extension '", path.extension().string(),
             "' is no surface format known here; supported are ", surface_extensions());
}

}  // namespace mw::io
