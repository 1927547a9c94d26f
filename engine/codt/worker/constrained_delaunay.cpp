// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The only file that knows TetGen (1.5.0); the program that it is linked into is under the AGPL.
#include "engine/codt/worker/constrained_delaunay.h"

#include <tetgen.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <new>
#include <string>

namespace mw::engine::codt {
namespace {

constexpr unsigned kSeed = 1;
constexpr std::uint32_t kNoRegion = 0xffffffffU;
constexpr int kOutOfMemory = 1;  // of TetGen's numbers

/// p: triangulate a piecewise linear complex; Y: put no Steiner points on facets and segments; A:
/// give each tet the number of its region; Q: print nothing.
constexpr const char* kSwitches = "pYAQ";

void set_points(const Plc& plc, tetgenio& in) {
  in.numberofpoints = static_cast<int>(plc.points.size());
  in.pointlist = new REAL[3 * plc.points.size()];
  REAL* next = in.pointlist;
  for (const PlcPoint& p : plc.points) next = std::copy(p.begin(), p.end(), next);
}

/// Each facet has a marker of its own: TetGen merges coplanar neighbours that share one.
void set_facets(const Plc& plc, tetgenio& in) {
  in.numberoffacets = static_cast<int>(plc.facets.size());
  in.facetlist = new tetgenio::facet[plc.facets.size()];
  in.facetmarkerlist = new int[plc.facets.size()];
  for (std::size_t i = 0; i < plc.facets.size(); ++i) {
    tetgenio::facet& facet = in.facetlist[i];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    facet.polygonlist[0].numberofvertices = 3;
    facet.polygonlist[0].vertexlist = new int[3];
    for (std::size_t k = 0; k < 3; ++k) {
      facet.polygonlist[0].vertexlist[k] = static_cast<int>(plc.facets[i][k]);
    }
    in.facetmarkerlist[i] = static_cast<int>(i) + 1;
  }
}

/// Regions are numbered from 1: a tet that no seed reaches has another attribute.
void set_regions(const Plc& plc, tetgenio& in) {
  in.numberofregions = static_cast<int>(plc.seeds.size());
  in.regionlist = new REAL[5 * plc.seeds.size()];
  REAL* next = in.regionlist;
  for (std::size_t i = 0; i < plc.seeds.size(); ++i) {
    next = std::copy(plc.seeds[i].begin(), plc.seeds[i].end(), next);
    *next++ = static_cast<REAL>(i + 1);
    *next++ = 0.0;
  }
}

std::uint32_t region_of(const tetgenio& out, std::size_t tet, std::size_t regions) {
  if (out.numberoftetrahedronattributes != 1) return kNoRegion;
  const REAL attribute = out.tetrahedronattributelist[tet];
  const bool known = attribute >= 1.0 && attribute <= static_cast<REAL>(regions) &&
                     attribute == std::floor(attribute);
  return known ? static_cast<std::uint32_t>(attribute) - 1 : kNoRegion;
}

Triangulation read_result(const Plc& plc, const tetgenio& out) {
  Triangulation made;
  for (auto i = plc.points.size(); i < static_cast<std::size_t>(out.numberofpoints); ++i) {
    const REAL* p = out.pointlist + 3 * i;
    made.added.push_back({p[0], p[1], p[2]});
  }
  for (std::size_t t = 0; t < static_cast<std::size_t>(out.numberoftetrahedra); ++t) {
    const int* corners = out.tetrahedronlist + t * static_cast<std::size_t>(out.numberofcorners);
    std::array<std::uint32_t, 4> tet{};
    std::transform(corners, corners + 4, tet.begin(),
                   [](int row) { return static_cast<std::uint32_t>(row); });
    made.tets.push_back(tet);
    made.regions.push_back(region_of(out, t, plc.seeds.size()));
  }
  return made;
}

}  // namespace

std::optional<Triangulation> constrained_delaunay(const Plc& plc) {
  tetgenio in, out;
  set_points(plc, in);
  set_facets(plc, in);
  set_regions(plc, in);
  std::srand(kSeed);  // NOLINT(cert-msc51-cpp): TetGen calls rand(); answers must repeat
  try {
    std::string switches = kSwitches;
    tetrahedralize(switches.data(), &in, &out);
  } catch (int reason) {  // terminatetetgen()
    if (reason == kOutOfMemory) throw std::bad_alloc();
    return std::nullopt;
  }
  if (static_cast<std::size_t>(out.numberofpoints) < plc.points.size()) return std::nullopt;
  return read_result(plc, out);
}

}  // namespace mw::engine::codt
