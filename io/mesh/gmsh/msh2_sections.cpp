// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads the sections of .msh 2.2, which many tools still write.
#include "io/mesh/gmsh/msh_sections.h"

#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/mesh/gmsh/msh_common.h"

namespace mw::io {
namespace {

/// Reads the count of a section, which is text in binary files too.
std::uint64_t read_rows(MshInput& in) {
  const auto rows = parse_integer(in.next_line("a number of rows"));
  if (!rows || *rows < 0) in.fail("no number of rows");
  return static_cast<std::uint64_t>(*rows);
}

std::uint64_t positive(const MshInput& in, std::int64_t number) {
  if (number < 0) in.fail(text(number, " stands where the number of a node is expected"));
  return static_cast<std::uint64_t>(number);
}

/// What the head of an element says: how many nodes and tags it has, and whether it is a tet.
struct Kind {
  std::uint64_t nodes = 0;
  std::uint64_t tags = 0;
  bool tet = false;
};

Kind kind_of(const MshInput& in, std::int64_t type, std::int64_t tags) {
  constexpr std::int64_t kMaxTags = 1 << 20;
  const std::uint64_t nodes = msh_nodes_of(type);
  if (nodes == 0) in.fail(text("elements of type ", type, " are not known here"));
  if (tags < 0 || tags > kMaxTags) in.fail(text(tags, " tags of an element"));
  return {nodes, static_cast<std::uint64_t>(tags), is_msh_tet(type)};
}

/// Reads the tags and nodes of one element.
void read_element(MshInput& in, std::int64_t element, const Kind& kind, MshContent& out) {
  std::int64_t physical = 0;
  std::int64_t entity = 0;
  for (std::uint64_t i = 0; i < kind.tags; ++i) {
    const std::int64_t tag = in.integer("a tag of an element");
    if (i == 0) physical = tag;
    if (i == 1) entity = tag;
  }
  std::vector<std::uint64_t> nodes(kind.nodes);
  for (std::uint64_t& node : nodes) node = positive(in, in.integer("a node of an element"));
  ++out.elements;
  if (!kind.tet) return;
  const std::int64_t number = physical != 0 ? without_sign(in, physical) : entity;
  out.mesh.add_tet(nodes, static_cast<RawLabel>(number));
  out.numbers.push_back(static_cast<std::uint64_t>(element));
}

void read_text_element(MshInput& in, MshContent& out) {
  const std::int64_t element = in.integer("the number of an element");
  const std::int64_t type = in.integer("a type of elements");
  read_element(in, element, kind_of(in, type, in.integer("a number of tags")), out);
}

/// Reads elements of one type behind a common head.
void read_element_block(MshInput& in, std::uint64_t max, MshContent& out) {
  const std::int64_t type = in.integer("a type of elements");
  const std::int64_t rows = in.integer("a number of elements");
  const Kind kind = kind_of(in, type, in.integer("a number of tags"));
  if (rows < 1 || static_cast<std::uint64_t>(rows) > max) {
    in.fail(text("a block of ", rows, " elements, where ", max, " are left"));
  }
  for (std::int64_t i = 0; i < rows; ++i) {
    const std::int64_t element = in.integer("the number of an element");
    read_element(in, element, kind, out);
  }
}

}  // namespace

void read_msh2_nodes(MshInput& in, MshContent& out) {
  const std::uint64_t rows = read_rows(in);
  in.check_rows(rows, sizeof(std::int32_t) + 3 * sizeof(double), 4);
  for (std::uint64_t i = 0; i < rows; ++i) {
    const std::uint64_t tag = positive(in, in.integer("the number of a node"));
    Position position{};
    for (double& x : position) x = in.real("a coordinate");
    out.mesh.add_node(tag, position);
  }
  in.end_section("Nodes");
}

void read_msh2_elements(MshInput& in, MshContent& out) {
  const std::uint64_t rows = read_rows(in);
  while (out.elements < rows) {
    in.ascii() ? read_text_element(in, out) : read_element_block(in, rows - out.elements, out);
  }
  in.end_section("Elements");
}

}  // namespace mw::io
