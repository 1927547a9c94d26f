// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers of facet groups, for formats that have no names.
#pragma once

#include "io/file/atomic_file.h"
#include "io/mesh/grouped/group_names.h"

namespace mw::io {

/// A run of facets under one number.
struct NumberedFacets {
  std::int64_t number = 0;
  std::string name;  ///< see GroupNames::facets
  Side side = Side::kInterface;
  Label first = kExterior;  ///< of an interface its labels, by rank; else kExterior
  Label second = kExterior;
  RowRange facets;
};

/// Sides of the box have the numbers 1 to 6 (x_min, x_max, y_min, y_max, z_min, z_max), the outer
/// surface has 7, whatever the mesh; all labels share them.  Interfaces have 8 and more, ascending
/// by their two labels.
/// ENSURES: in the order of the facets, which all are in one run.
[[nodiscard]] std::vector<NumberedFacets> number_facets(const GroupedMesh& mesh);

/// The table beside a mesh: M.facets.csv of M.xdmf.
[[nodiscard]] std::filesystem::path facet_table_path(const std::filesystem::path& mesh);

/// Its content: columns number, name, side, first, second; the last two are the labels of an
/// interface and else empty.  The file is to be committed with the mesh (commit_together.h).
/// ERRORS: see AtomicFile.
void append_facet_table(AtomicFile& file, const LabelTable& table,
                        const std::vector<NumberedFacets>& facets);

}  // namespace mw::io
