// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Cards are those of the LS-DYNA Keyword User's Manual, volume I.
#include "io/mesh/lsdyna/k_writer.h"

#include "io/file/errors.h"
#include "io/mesh/grouped/fixed_fields.h"
#include "io/mesh/grouped/group_names.h"

namespace mw::io {
namespace {

constexpr int kDigits = 9;          // behind the point of a coordinate
constexpr std::size_t kShort = 8;   // columns of a field in nodes and elements
constexpr std::size_t kField = 10;  // columns of other fields

/// The four parts of a triangle, by its corners and the middles of its edges 0 1, 1 2 and 2 0.
constexpr std::array<std::array<std::size_t, 3>, 4> kQuarters{
    {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};

std::string card(std::initializer_list<std::uint64_t> numbers, std::size_t columns) {
  std::string out;
  for (const std::uint64_t number : numbers) out += fixed_integer(number, columns);
  return out;
}

void write_k_nodes(TabledFile& file, GroupedMesh& mesh) {
  constexpr std::size_t kPlace = 16;
  file.line("*NODE");
  for (std::uint64_t row = 0; row < mesh.node_count(); ++row) {
    std::string out = fixed_integer(row + 1, kShort);
    for (const double x : mesh.node(row)) out += fixed_coordinate(file.name, x, kPlace, kDigits);
    file.line(out);
  }
}

void write_k_part(TabledFile& file, GroupedMesh& mesh, RowRange tets, std::int64_t number,
                  const std::string& name) {
  const auto part = static_cast<std::uint64_t>(number);
  file.line("*PART");
  file.line(name);
  file.line(card({part, 1, part}, kField));
  file.line("*MAT_ELASTIC");
  file.line(fixed_integer(part, kField) + "       1.0       1.0       0.3");
  file.line("*ELEMENT_SOLID");
  for (std::uint64_t t = tets.begin; t < tets.end; ++t) {
    constexpr std::size_t kBrick = 8;
    const std::string head = card({t + 1, part}, kShort);
    std::string row;
    std::uint64_t last = 0;
    const NodeRows nodes = mesh.tet_nodes(t);
    for (const std::uint64_t node : nodes) {
      last = node + 1;
      row += fixed_integer(last, kShort);
    }
    if (nodes.size() > kBrick) {
      file.line(head);
      file.line(row);
      continue;
    }
    for (std::size_t i = nodes.size(); i < kBrick; ++i) row += fixed_integer(last, kShort);
    file.line(head + row);
  }
}

void begin_set(TabledFile& file, const char* keyword, const std::string& title,
               std::uint64_t number) {
  file.line(keyword);
  file.line(title);
  file.line(fixed_integer(number, kField));
}

void write_part_sets(TabledFile& file, const GroupedMesh& mesh, const PlainNames& names,
                     const LabelNumbers& numbers) {
  constexpr std::size_t kOnLine = 8;
  const std::vector<MaskGroup> masks = mask_groups(mesh);
  for (std::size_t i = 0; i < masks.size(); ++i) {
    begin_set(file, "*SET_PART_LIST_TITLE", names.mask(i), i + 1);
    std::string row;
    for (const Label rank : masks[i].ranks) {
      row += fixed_integer(static_cast<std::uint64_t>(numbers[rank]), kField);
      if (row.size() < kOnLine * kField) continue;
      file.line(row);
      row.clear();
    }
    if (!row.empty()) file.line(row);
  }
}

void write_k_node_set(TabledFile& file, GroupedMesh& mesh, const NamedFacets& set, bool of_second,
                      std::uint64_t number) {
  constexpr std::size_t kOnLine = 8;
  begin_set(file, "*SET_NODE_LIST_TITLE", of_second ? set.other : set.name, number);
  std::string row;
  const auto add = [&](std::uint64_t node) {
    row += fixed_integer(node + 1, kField);
    if (row.size() < kOnLine * kField) return;
    file.line(row);
    row.clear();
  };
  for_each_facet_node(mesh, set.group.facets, add, of_second);
  if (!row.empty()) file.line(row);
}

void write_segments(TabledFile& file, GroupedMesh& mesh, const NamedFacets& set, bool of_second,
                    std::uint64_t number) {
  begin_set(file, "*SET_SEGMENT_TITLE", of_second ? set.other : set.name, number);
  const RowRange facets = set.group.facets;
  for (std::uint64_t f = facets.begin; f < facets.end; ++f) {
    const Facet facet = of_second ? mesh.of_second(mesh.facet(f)) : mesh.facet(f);
    const NodeRows nodes = mesh.facet_nodes(facet);
    const auto put = [&](const std::array<std::size_t, 3>& corners) {
      const auto node = [&](std::size_t i) { return nodes.begin()[corners[i]] + 1; };
      file.line(card({node(0), node(1), node(2), node(2)}, kField));
    };
    if (nodes.size() == 3) {
      put({0, 1, 2});
    } else {
      for (const auto& quarter : kQuarters) put(quarter);
    }
  }
}

}  // namespace

void write_k(TabledFile& file, GroupedMesh& mesh) {
  check_number(file.name, std::max(mesh.node_count(), mesh.tet_count()),
               {.max = kMaxFieldNumber, .subject = "LS-DYNA has", .others = ".exo or .vtkhdf"});
  check_digits(file.name, mesh, kDigits + 1);
  constexpr std::uint64_t kTet4Form = 10, kTet10Form = 16;
  const bool ten = has_middles(mesh.element());
  const LabelNumbers numbers(mesh.table(), {.max = kMaxFieldNumber});
  const PlainNames names(mesh);
  file.line("*KEYWORD");
  file.line("*TITLE");
  file.line(text("mwmesh: tetrahedra of ", mesh.table().size(), " labels"));
  file.line("$ Materials are placeholders.  FACE_1_2 is where labels 1 and 2 meet.");
  write_k_nodes(file, mesh);
  file.line("*SECTION_SOLID");
  file.line(card({1, ten ? kTet10Form : kTet4Form}, kField));
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    write_k_part(file, mesh, mesh.label_tets()[rank], numbers[rank], names.volume(rank));
  }
  write_part_sets(file, mesh, names, numbers);
  std::uint64_t node_sets = 0, segment_sets = 0;
  for_each_named(mesh, names, [&](const NamedFacets& set) {
    write_k_node_set(file, mesh, set, false, ++node_sets);
    if (set.is_split) write_k_node_set(file, mesh, set, true, ++node_sets);
    write_segments(file, mesh, set, false, ++segment_sets);
    if (!set.other.empty()) write_segments(file, mesh, set, true, ++segment_sets);
  });
  file.line("*END");
  file.commit(mesh, numbers);
}

}  // namespace mw::io
