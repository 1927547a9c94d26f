// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Generators of small volumes and their five-tet meshes.
#include "tests/oracle/small_volumes.h"

#include <algorithm>
#include <array>
#include <limits>

namespace mw::audit::test {
namespace {

/// Not in the first or last layer of an axis, if that leaves any.
Index3 random_voxel(std::mt19937& random, Index3 shape) {
  const auto one_of = [&](std::int64_t count) {
    return count < 3 ? 0 : 1 + std::int64_t{below(random, static_cast<std::uint32_t>(count - 2))};
  };
  const auto x = one_of(shape.x), y = one_of(shape.y), z = one_of(shape.z);
  return {x, y, z};
}

SmallVolume noise(std::mt19937& random, Index3 shape, std::uint32_t labels) {
  return volume_from(shape, labels, [&](auto, auto, auto) { return below(random, labels); });
}

/// Mostly one label, full of holes.
SmallVolume sponge(std::mt19937& random, Index3 shape, std::uint32_t labels) {
  const std::uint32_t max = below(random, labels);
  return volume_from(shape, labels, [&](auto, auto, auto) {
    return below(random, 4) != 0 ? max : below(random, labels);
  });
}

/// Cells of a few random seeds.
SmallVolume blobs(std::mt19937& random, Index3 shape, std::uint32_t labels) {
  struct Seed {
    std::int64_t x, y, z;
    Label label;
  };
  std::vector<Seed> seeds;
  for (std::uint32_t i = 0; i < 2 * labels; ++i) {
    const auto within = [&](std::int64_t edge) {
      return below(random, static_cast<std::uint32_t>(std::max<std::int64_t>(edge, 5)));
    };
    const auto x = within(shape.x), y = within(shape.y), z = within(shape.z);
    seeds.push_back({x, y, z, i % labels});
  }
  return volume_from(shape, labels, [&](auto x, auto y, auto z) {
    const auto away = [&](const Seed& s) {
      return (s.x - x) * (s.x - x) + (s.y - y) * (s.y - y) + (s.z - z) * (s.z - z);
    };
    return std::min_element(seeds.begin(), seeds.end(),
                            [&](const Seed& a, const Seed& b) { return away(a) < away(b); })
        ->label;
  });
}

SmallVolume checkerboard(std::mt19937& random, Index3 shape, std::uint32_t labels) {
  const auto step = 1 + below(random, 2);
  return volume_from(shape, labels, [&](auto x, auto y, auto z) {
    return (x / step + y / step + z / step) % labels;
  });
}

/// Nested boxes around a random voxel.
SmallVolume shells(std::mt19937& random, Index3 shape, std::uint32_t labels) {
  const Index3 centre = random_voxel(random, shape);
  const std::uint32_t first = below(random, labels);
  return volume_from(shape, labels, [&](auto x, auto y, auto z) {
    const Index3 away = Index3{x, y, z} - centre;
    return (first + std::max({std::abs(away.x), std::abs(away.y), std::abs(away.z)})) % labels;
  });
}

/// Square rings, one inside the other, around a bar along z.
SmallVolume rings(std::mt19937& random, Index3 shape, std::uint32_t labels) {
  const Index3 centre = random_voxel(random, shape);
  const std::uint32_t first = below(random, labels);
  return volume_from(shape, labels, [&](auto x, auto y, auto z) {
    const Index3 away = Index3{x, y, z} - centre;
    const auto ring = std::max(std::abs(away.x), std::abs(away.y));
    const bool in_slab = std::abs(away.z) <= 1 && ring < 3;
    return (first + (in_slab || ring == 0 ? ring : labels - 1)) % labels;
  });
}

/// Layers one voxel thick, two or three apart, some voxels missing.
SmallVolume sheets(std::mt19937& random, Index3 shape, std::uint32_t labels) {
  const std::uint32_t axis = below(random, 3), apart = 2 + below(random, 2);
  return volume_from(shape, labels, [&](auto x, auto y, auto z) {
    const auto layer = axis == 0 ? x : axis == 1 ? y : z;
    const bool in_sheet = layer % apart == 1 && below(random, 8) != 0;
    return in_sheet ? (1 + layer / apart) % labels : 0;
  });
}

/// One label, and single voxels of others.
SmallVolume specks(std::mt19937& random, Index3 shape, std::uint32_t labels) {
  return volume_from(shape, labels, [&](auto, auto, auto) {
    return below(random, 12) == 0 ? below(random, labels) : 0;
  });
}

using Generator = SmallVolume (*)(std::mt19937&, Index3, std::uint32_t);
constexpr std::array<Generator, kVolumeKinds> kGenerators{noise,  blobs, checkerboard, sponge,
                                                          shells, rings, sheets,       specks};

}  // namespace

SmallVolume random_volume_of(std::mt19937& random, VolumeKind kind, Index3 shape,
                             std::uint32_t labels) {
  return kGenerators[static_cast<std::size_t>(kind)](random, shape, labels);
}

std::string SmallVolume::text() const {
  std::string text =
      std::to_string(shape.x) + "x" + std::to_string(shape.y) + "x" + std::to_string(shape.z) + " ";
  for (const Label label : labels) text += static_cast<char>('0' + label);
  return text;
}

std::uint32_t below(std::mt19937& random, std::uint32_t count) {
  return static_cast<std::uint32_t>(random() % count);
}

VolumeKind random_kind(std::mt19937& random) {
  return static_cast<VolumeKind>(below(random, kVolumeKinds));
}

Index3 random_shape(std::mt19937& random, std::uint32_t min, std::uint32_t max) {
  const auto edge = [&] { return std::int64_t{min + below(random, max - min + 1)}; };
  const auto x = edge(), y = edge(), z = edge();
  return {x, y, z};
}

SmallVolume random_volume(std::mt19937& random) {
  const std::size_t kind = below(random, 6);
  const Index3 shape = random_shape(random, kind < 3 ? 1 : 3, 5);
  const std::uint32_t labels = 1 + below(random, 4);
  SmallVolume volume = kGenerators[kind](random, shape, labels);
  for (std::uint32_t flips = below(random, 4); flips > 0; --flips) {
    const auto voxel = below(random, static_cast<std::uint32_t>(volume.labels.size()));
    volume.labels[voxel] = below(random, labels);
  }
  return volume;
}

SmallMesh five_tet_mesh(const SmallVolume& volume, const Frame& frame) {
  // Corners by bits x + 2y + 4z; the odd pattern is the even one mirrored in x, then turned.
  constexpr std::array<TetRow, 5> kEven{
      {{0, 1, 2, 4}, {3, 2, 1, 7}, {5, 1, 4, 7}, {6, 4, 2, 7}, {1, 2, 4, 7}}};
  SmallMesh mesh;
  const Index3 s = volume.shape;
  const Index3 corners{s.x + 1, s.y + 1, s.z + 1};
  for (std::int64_t i = 0; i < corners.product(); ++i) {
    const std::array<std::int64_t, 3> at{i % corners.x, i / corners.x % corners.y,
                                         i / corners.x / corners.y};
    Position p{};
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = frame.origin[k] + static_cast<double>(at[k]) * frame.spacing[k];
    }
    mesh.vertices.push_back(p);
  }
  for (std::int64_t i = 0; i < s.product(); ++i) {
    const Index3 v{i % s.x, i / s.x % s.y, i / s.x / s.y};
    const bool odd = (v.x + v.y + v.z) % 2 != 0;
    for (const TetRow& pattern : kEven) {
      TetRow tet{};
      for (std::size_t k = 0; k < 4; ++k) {
        const auto bits = static_cast<std::int64_t>(odd ? pattern[k] ^ 1U : pattern[k]);
        const Index3 c = v + Index3{bits & 1, bits >> 1 & 1, bits >> 2};
        tet[k] = static_cast<std::uint64_t>((c.z * corners.y + c.y) * corners.x + c.x);
      }
      if (odd) std::swap(tet[0], tet[1]);
      mesh.tets.push_back(tet);
      mesh.labels.push_back(volume.labels[static_cast<std::size_t>(i)]);
    }
  }
  return mesh;
}

SmallMesh kept_part(const SmallMesh& mesh, const KeptLabels& kept) {
  SmallMesh out;
  std::vector<std::uint64_t> row(mesh.vertices.size(), ~std::uint64_t{0});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (!keeps(kept, mesh.labels[t])) continue;
    TetRow tet = mesh.tets[t];
    for (std::uint64_t& v : tet) {
      if (row[v] == ~std::uint64_t{0}) {
        row[v] = out.vertices.size();
        out.vertices.push_back(mesh.vertices[v]);
      }
      v = row[v];
    }
    out.tets.push_back(tet);
    out.labels.push_back(mesh.labels[t]);
  }
  return out;
}

}  // namespace mw::audit::test
