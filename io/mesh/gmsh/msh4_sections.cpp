// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads the sections of .msh 4.1.
#include "io/mesh/gmsh/msh_sections.h"

#include "io/file/errors.h"
#include "io/mesh/gmsh/msh_common.h"

namespace mw::io {
namespace {

constexpr std::int64_t kVolume = 3;

/// Reads a list of 32-bit numbers behind their count; returns the first, or 0 where there is none.
std::int64_t read_tags(MshInput& in, std::string_view expected) {
  const std::uint64_t count = in.count(expected);
  in.check_rows(count, sizeof(std::int32_t), 1);
  std::int64_t first = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::int64_t tag = in.integer(expected);
    if (i == 0) first = tag;
  }
  return first;
}

void read_entity(MshInput& in, std::int64_t dimension, MshContent& out) {
  const std::int64_t tag = in.integer("the tag of an entity");
  in.skip_reals(dimension == 0 ? 3 : 6);  // its place or box
  const std::int64_t physical = read_tags(in, "a physical group");
  if (dimension == kVolume && physical != 0) {
    out.physical_of[tag] = without_sign(in, physical);
  }
  if (dimension > 0) static_cast<void>(read_tags(in, "what bounds an entity"));
}

/// Reads a block of nodes: their numbers, then their positions.
void read_node_block(MshInput& in, MshContent& out) {
  const std::int64_t dimension = in.integer("the dimension of a block of nodes");
  static_cast<void>(in.integer("the entity of a block of nodes"));
  const bool parametric = in.integer("whether nodes are parametric") != 0;
  if (dimension < 0 || dimension > kVolume) in.fail(text("no entity has dimension ", dimension));
  const std::uint64_t rows = in.count("a number of nodes");
  in.check_rows(rows, 4 * sizeof(double), 4);
  std::vector<std::uint64_t> tags(rows);
  for (std::uint64_t& tag : tags) tag = in.count("the number of a node");
  for (const std::uint64_t tag : tags) {
    Position position{};
    for (double& x : position) x = in.real("a coordinate");
    if (parametric) in.skip_reals(dimension);
    out.mesh.add_node(tag, position);
  }
}

std::uint64_t read_element_block(MshInput& in, MshContent& out) {
  static_cast<void>(in.integer("the dimension of a block of elements"));
  const std::int64_t entity = in.integer("the entity of a block of elements");
  const std::int64_t type = in.integer("a type of elements");
  const std::uint64_t rows = in.count("a number of elements");
  const std::uint64_t nodes = msh_nodes_of(type);
  if (nodes == 0) in.fail(text("elements of type ", type, " are not known here"));
  in.check_rows(rows, (1 + nodes) * sizeof(std::uint64_t), 1 + nodes);
  std::vector<std::uint64_t> tags(nodes);
  for (std::uint64_t i = 0; i < rows; ++i) {
    const std::uint64_t element = in.count("the number of an element");
    for (std::uint64_t& tag : tags) tag = in.count("a node of an element");
    if (!is_msh_tet(type)) continue;
    out.mesh.add_tet(tags, static_cast<RawLabel>(entity));
    out.numbers.push_back(element);
  }
  return rows;
}

/// Reads the head of a section of blocks, and returns the number of blocks.
std::uint64_t read_head(MshInput& in, std::uint64_t& rows) {
  const std::uint64_t blocks = in.count("a number of blocks");
  rows = in.count("a number of rows");
  static_cast<void>(in.count("the least number"));
  static_cast<void>(in.count("the largest number"));
  return blocks;
}

void check_sum(const MshInput& in, std::uint64_t found, std::uint64_t announced) {
  if (found != announced) {
    in.fail(text(found, " rows in the blocks, ", announced, " were announced"));
  }
}

}  // namespace

void read_msh4_entities(MshInput& in, MshContent& out) {
  std::array<std::uint64_t, 4> counts{};
  for (std::uint64_t& count : counts) count = in.count("a number of entities");
  for (std::size_t dimension = 0; dimension < counts.size(); ++dimension) {
    for (std::uint64_t i = 0; i < counts[dimension]; ++i) {
      read_entity(in, static_cast<std::int64_t>(dimension), out);
    }
  }
  in.end_section("Entities");
}

void read_msh4_nodes(MshInput& in, MshContent& out) {
  std::uint64_t rows = 0;
  const std::uint64_t blocks = read_head(in, rows);
  for (std::uint64_t i = 0; i < blocks; ++i) read_node_block(in, out);
  check_sum(in, out.mesh.node_count(), rows);
  in.end_section("Nodes");
}

void read_msh4_elements(MshInput& in, MshContent& out) {
  std::uint64_t rows = 0;
  const std::uint64_t blocks = read_head(in, rows);
  for (std::uint64_t i = 0; i < blocks; ++i) out.elements += read_element_block(in, out);
  check_sum(in, out.elements, rows);
  in.end_section("Elements");
}

}  // namespace mw::io
