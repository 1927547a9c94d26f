// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a viewer may sort segments by, measured while a surface is written.
#include "io/surface/precomputed/measured_sink.h"

#include <cmath>
#include <set>

#include "kernels/core/vector3.h"

namespace mw::io {
namespace {

std::uint32_t neighbours_of(const SurfaceHeader& header) {
  std::set<Label> out;
  for (const SurfaceShell& shell : header.shells) {
    for (const SurfaceRun& run : shell.runs) {
      if (run.side == Side::kInterface) out.insert(run.outside);
    }
  }
  out.erase(kExterior);
  return static_cast<std::uint32_t>(out.size());
}

}  // namespace

void MeasuredSink::begin(const SurfaceHeader& header) {
  figures_.neighbours = neighbours_of(header);
  sink_->begin(header);
}

void MeasuredSink::write_vertices(std::span<const Position> positions) {
  if (vertices_.size() == 0 && !positions.empty()) first_ = positions.front();
  for (const Position& position : positions) {
    vertices_.append(position);
    if (!figures_.box) figures_.box = SegmentBox{position, position};
    figures_.box->add(position);
  }
  sink_->write_vertices(positions);
}

void MeasuredSink::write_triangles(std::span<const Triangle> triangles) {
  for (const Triangle& t : triangles) {
    const Position a = minus(vertices_[t[0]], first_);
    const Position b = minus(vertices_[t[1]], first_);
    const Position c = minus(vertices_[t[2]], first_);
    figures_.area += norm(cross(minus(b, a), minus(c, a))) / 2;
    volume6_ += determinant(a, b, c);
  }
  sink_->write_triangles(triangles);
}

void MeasuredSink::finish() {
  if (closed_) figures_.volume = std::abs(volume6_) / 6;
  sink_->finish();
}

}  // namespace mw::io
