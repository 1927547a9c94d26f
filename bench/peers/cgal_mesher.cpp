// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// CGAL Mesh_3, sequential.
#include "bench/peers/cgal_mesher.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Image_3.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/make_mesh_3.h>

#include <algorithm>
#include <map>

namespace mw::peers {
namespace {

namespace params = CGAL::parameters;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Domain = CGAL::Labeled_mesh_domain_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain, CGAL::Default, CGAL::Sequential_tag>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

constexpr unsigned kSeed = 0;
/// The error of surface points, relative to the size of the volume; CGAL's default, 1e-3, is a
/// voxel and more.
constexpr double kRelativeErrorBound = 1e-4;

/// The image with its layer of kOutside; the first corner of the volume is at 0, because the
/// image has only floats for its place.
CGAL::Image_3 padded_image(std::span<const std::uint16_t> subdomains, const io::VolumeInfo& info) {
  const Box3 inner{{1, 1, 1}, info.shape + Index3{1, 1, 1}};
  const Box3 whole{{0, 0, 0}, info.shape + Index3{2, 2, 2}};
  const auto size = [](std::int64_t n) { return static_cast<std::size_t>(n); };
  const std::array<double, 3>& d = info.space.spacing;
  _image* image = _createImage(size(whole.hi.x), size(whole.hi.y), size(whole.hi.z), 1, d[0], d[1],
                               d[2], sizeof(std::uint16_t), WK_FIXED, SGN_UNSIGNED);
  image->tx = static_cast<float>(-0.5 * d[0]);
  image->ty = static_cast<float>(-0.5 * d[1]);
  image->tz = static_cast<float>(-0.5 * d[2]);
  auto* voxels = static_cast<std::uint16_t*>(image->data);
  std::fill_n(voxels, whole.voxels(), kOutside);
  for (std::int64_t z = 0; z < info.shape.z; ++z) {
    for (std::int64_t y = 0; y < info.shape.y; ++y) {
      const auto row = (z * info.shape.y + y) * info.shape.x;
      std::copy_n(subdomains.begin() + row, info.shape.x,
                  voxels + whole.offset(inner.lo + Index3{0, y, z}));
    }
  }
  return CGAL::Image_3(image);
}

Criteria in_physical_units(const CgalCriteria& c, const std::array<double, 3>& spacing) {
  const double voxel = *std::min_element(spacing.begin(), spacing.end());
  return Criteria(params::facet_angle = c.facet_angle, params::facet_size = c.facet_size * voxel,
                  params::facet_distance = c.facet_distance * voxel,
                  params::cell_radius_edge_ratio = c.cell_radius_edge_ratio,
                  params::cell_size = c.cell_size * voxel);
}

Complex refine(const Domain& domain, const Criteria& criteria, Improvement improvement) {
  switch (improvement) {
    case Improvement::kNone:
      return CGAL::make_mesh_3<Complex>(domain, criteria, params::no_perturb(), params::no_exude());
    case Improvement::kTimed:
      return CGAL::make_mesh_3<Complex>(domain, criteria);
    case Improvement::kFull:
      break;
  }
  return CGAL::make_mesh_3<Complex>(domain, criteria, params::perturb(params::time_limit = 0),
                                    params::exude(params::time_limit = 0));
}

/// Vertices get rows in the order in which tets name them.
io::MeshData mesh_data(const Complex& complex, const std::array<double, 3>& origin) {
  io::MeshData mesh;
  std::map<Triangulation::Vertex_handle, std::uint64_t> rows;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end();
       ++cell) {
    io::TetRows tet{};
    for (int i = 0; i < 4; ++i) {
      const auto [row, is_new] = rows.try_emplace(cell->vertex(i), mesh.vertices.size());
      tet[static_cast<std::size_t>(i)] = row->second;
      const auto& p = cell->vertex(i)->point();
      if (!is_new) continue;
      mesh.vertices.push_back({p.x() + origin[0], p.y() + origin[1], p.z() + origin[2]});
    }
    mesh.tets.push_back(tet);
    mesh.labels.push_back(static_cast<RawLabel>(complex.subdomain_index(cell)));
  }
  return mesh;
}

}  // namespace

io::MeshData mesh_with_cgal(std::span<const std::uint16_t> subdomains, const io::VolumeInfo& info,
                            const CgalCriteria& criteria) {
  CGAL::get_default_random() = CGAL::Random(kSeed);  // else the clock is its seed
  CGAL::Random random(kSeed);
  const CGAL::Image_3 image = padded_image(subdomains, info);
  const Domain domain = Domain::create_labeled_image_mesh_domain(
      image, params::relative_error_bound = kRelativeErrorBound, params::p_rng = &random);
  const Complex complex =
      refine(domain, in_physical_units(criteria, info.space.spacing), criteria.improvement);
  return mesh_data(complex, info.space.origin);
}

}  // namespace mw::peers
