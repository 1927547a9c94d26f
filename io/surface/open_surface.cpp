// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes surfaces in every format there is.
#include "io/surface/open_surface.h"

#include <array>

#include "io/file/errors.h"
#include "io/surface/ply/ply_sink.h"
#include "io/surface/stl/stl_sink.h"

namespace mw::io {
namespace {

struct SurfaceFormat {
  const char* extension;
  std::unique_ptr<SurfaceSink> (*open)(const std::filesystem::path&);
};

template <class Sink>
std::unique_ptr<SurfaceSink> open(const std::filesystem::path& path) {
  return std::make_unique<Sink>(path);
}

constexpr std::array kFormats{
    SurfaceFormat{".stl", &open<StlSink>},
    SurfaceFormat{".ply", &open<PlySink>},
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

std::unique_ptr<SurfaceSink> open_surface_sink(const std::filesystem::path& path) {
  if (const SurfaceFormat* format = find_format(path)) return format->open(path);
  fail_usage(path.string(), ": extension '", path.extension().string(),
             "' is no surface format known here; supported are ", surface_extensions());
}

}  // namespace mw::io
