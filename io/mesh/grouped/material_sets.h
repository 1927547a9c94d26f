// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sets of tets by equal ranges of a value, which are the materials of a solver.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/file/scratch/external_sort.h"
#include "io/file/sink/atomic_file.h"
#include "io/mesh/grouped/grouped_mesh.h"

namespace mw::io {

/// Tells which materials are asked for.
struct MaterialRule {
  std::string values;       ///< one of MeshHeader::values
  std::uint32_t count = 0;  ///< number of ranges, from 1 to kMostMaterials
  /// The least value of the first range and the largest of the last; empty: those of all tets.
  std::optional<std::array<double, 2>> range{};
};

inline constexpr std::uint32_t kMostMaterials = 10000;

/// Materials are numbered from 1.  Material m has the values from least + (m - 1) * width to before
/// the least one of the next; the last material includes its end.  Values outside of a given range
/// are in the first or the last material, and tets without a value are in none.
class MaterialSets {
 public:
  struct Material {
    std::uint64_t tets = 0;
    double volume = 0;
    double mean = 0;  ///< mean of the values, by volume; 0 without tets
  };

  /// Cost: two passes over the tets.  ERRORS: mw::Error(kUsage) when the mesh has no such values.
  MaterialSets(GroupedMesh& mesh, const MaterialRule& rule);

  [[nodiscard]] std::uint32_t count() const { return rule_.count; }
  /// Returns the material of a tet, or 0 where the tet has no value.
  [[nodiscard]] std::uint32_t material_of(std::uint64_t tet);
  /// Returns "NAME_7", for programs that allow letters, digits and '_' alone.
  [[nodiscard]] std::string name(std::uint32_t material) const;
  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] const Material& facts(std::uint32_t material) const {
    return materials_[material - 1];
  }
  /// Calls visit(material, tet) by material, then by tet.  Memory: 8 MiB.  ERRORS: see ScratchFile.
  template <class Visit>
  void for_each(Visit visit) {
    constexpr std::size_t kSortBytes = 8 << 20;
    ExternalSort<2> rows(mesh_.folder(), kSortBytes);
    for (std::uint64_t t = 0; t < mesh_.tet_count(); ++t) {
      if (const std::uint32_t material = material_of(t); material > 0) rows.add({material, t});
    }
    rows.each([&](const std::array<std::uint64_t, 2>& row) {
      visit(static_cast<std::uint32_t>(row[0]), row[1]);
    });
  }
  /// Appends columns material, set, from, to, mean, tets, volume, to be committed with the mesh.
  void append_table(AtomicFile& file) const;

 private:
  [[nodiscard]] double bound(std::uint32_t material) const;

  GroupedMesh& mesh_;
  MaterialRule rule_;
  std::size_t column_ = 0;
  double least_ = 0;
  double most_ = 0;
  std::vector<Material> materials_;
};

/// Returns the path of the table beside a mesh: M.inp.materials.csv.
[[nodiscard]] std::filesystem::path material_table_path(const std::filesystem::path& mesh);

}  // namespace mw::io
