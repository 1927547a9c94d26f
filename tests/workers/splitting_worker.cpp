// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A worker that adds Steiner points, which TetGen hardly ever does: it cuts every seventh tet at
// its middle.
#include "engine/codt/worker/constrained_delaunay.h"
#include "engine/codt/worker/serve.h"

namespace {

using mw::Plc;
using mw::PlcPoint;
using mw::Triangulation;

constexpr std::size_t kCuts = 3;

PlcPoint middle(const Plc& plc, const std::array<std::uint32_t, 4>& tet) {
  PlcPoint sum{};
  for (std::uint32_t v : tet) {
    for (std::size_t k = 0; k < 3; ++k) sum[k] += 0.25 * plc.points[v][k];
  }
  return sum;
}

void split(const Plc& plc, std::size_t tet, Triangulation& made) {
  const auto corners = made.tets[tet];
  const auto point = static_cast<std::uint32_t>(plc.points.size() + made.added.size());
  made.added.push_back(middle(plc, corners));
  made.tets[tet][0] = point;
  for (std::size_t i = 1; i < 4; ++i) {
    made.tets.push_back(corners);
    made.tets.back()[i] = point;
    made.regions.push_back(made.regions[tet]);
  }
}

std::optional<Triangulation> triangulate(const Plc& plc) {
  std::optional<Triangulation> made = mw::engine::codt::constrained_delaunay(plc);
  if (!made || !made->added.empty()) return made;
  const std::size_t tets = made->tets.size();
  for (std::size_t t = 0; t < tets; t += tets / kCuts + 1) split(plc, t, *made);
  return made;
}

}  // namespace

int main() {
  mw::engine::codt::serve(triangulate);
  return 0;
}
