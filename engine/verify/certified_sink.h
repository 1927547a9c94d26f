// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A mesh that has to pass its own check before it gets its name.
#pragma once

#include <functional>

#include "engine/verify/mesh_tiles.h"
#include "io/mesh/tee_sink.h"

namespace mw::engine {

/// Passes a mesh on to a sink and to tiles.  When it is complete, certify() looks at the tiles;
/// when that throws, the sink is not finished, so that nothing appears under its name.
class CertifiedSink : public io::TeeSink {
 public:
  /// bytes: what certify() takes.  REQUIRES: sink and tiles outlive it.
  CertifiedSink(io::MeshSink& sink, MeshTiles& tiles, std::uint64_t bytes,
                std::function<void()> certify)
      : TeeSink(sink, tiles),
        sink_(sink),
        tiles_(tiles),
        bytes_(bytes),
        certify_(std::move(certify)) {}

  void finish() override {
    tiles_.finish();
    certify_();
    sink_.finish();
  }
  [[nodiscard]] std::uint64_t buffer_bytes() const override {
    return sink_.buffer_bytes() + bytes_;
  }

 private:
  io::MeshSink& sink_;
  MeshTiles& tiles_;
  std::uint64_t bytes_;
  std::function<void()> certify_;
};

}  // namespace mw::engine
