// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads a .msh file of Gmsh, and turns numbers of nodes into rows.
#include <algorithm>

#include "io/file/errors.h"
#include "io/file/source/inflated_source.h"
#include "io/file/text_numbers.h"
#include "io/mesh/field_names.h"
#include "io/mesh/gmsh/msh.h"
#include "io/mesh/gmsh/msh_common.h"
#include "io/mesh/gmsh/msh_sections.h"
#include "io/mesh/grouped/label_numbers.h"
#include "io/mesh/grouped/plain_names.h"
#include "io/mesh/kept_rows.h"

namespace mw::io {
namespace {

/// Reads the number 1, which tells the file's byte order.
ByteOrder read_order(MshInput& in) {
  in.set_binary(ByteOrder::kLittle);
  const std::int64_t one = in.integer("the number 1");
  if (one == 1) return ByteOrder::kLittle;
  if (one == 1 << 24) return ByteOrder::kBig;
  in.fail("the byte order is neither");
}

/// Reads the format, and returns whether the version is 4.1; otherwise it is 2.2.
bool read_format(MshInput& in) {
  if (in.next_section() != "MeshFormat") in.fail("not a .msh file");
  const std::string line(in.next_line("the version"));
  const std::vector<std::string_view> words = words_of(line);
  if (words.size() != 3) in.fail("no version, kind and size of numbers");
  const bool is_4 = words[0] == "4.1";
  if (!is_4 && words[0] != "2.2" && words[0] != "2.1" && words[0] != "2") {
    in.fail(text("version ", words[0], " is not read"));
  }
  if (words[2] != "8") in.fail(text("numbers of ", words[2], " bytes are not read"));
  if (words[1] == "1") in.set_binary(read_order(in));
  if (words[1] != "0" && words[1] != "1") in.fail(text("kind ", words[1], " of file"));
  in.end_section("MeshFormat");
  return is_4;
}

/// Reads one line: dimension, number, name in quotes.
void read_name(MshInput& in, MshContent& out) {
  const std::string_view line = in.next_line("a physical name");
  const std::size_t open = line.find('"');
  const std::size_t close = line.rfind('"');
  const auto numbers = parse_integers(line.substr(0, open));
  if (open == close || !numbers || numbers->size() != 2) in.fail("no physical name");
  if ((*numbers)[0] == 3) out.names[(*numbers)[1]] = line.substr(open + 1, close - open - 1);
}

void read_names(MshInput& in, MshContent& out) {
  const auto rows = parse_integer(in.next_line("a number of names"));
  if (!rows) in.fail("no number of names");
  for (std::int64_t i = 0; i < *rows; ++i) read_name(in, out);
  in.end_section("PhysicalNames");
}

/// Reads comments, which begin with the record where this program wrote them.
void read_comments(MshInput& in, MshContent& out) {
  const std::string line(in.next_line("a comment"));
  if (line == "$EndComments") return;
  if (line.starts_with(kMshRecord)) {
    out.record = parse_record(std::string_view(line).substr(kMshRecord.size()), in.name());
    if (out.record.curved) {
      fail_input(in.name(), "$Comments", "the tets are curved, which is not read from .msh",
                 "give the .vtkhdf or .vtu that it was converted from");
    }
  }
  in.skip_section("Comments");
}

/// Reads one section, or skips it where it is not needed.
void read_section(const std::string& section, bool is_4, MshInput& in, MshContent& out) {
  if (section == "PhysicalNames") {
    read_names(in, out);
  } else if (section == "Comments") {
    read_comments(in, out);
  } else if (section == "Entities" && is_4) {
    read_msh4_entities(in, out);
  } else if (section == "PartitionedEntities") {
    in.fail("the mesh is partitioned; save it whole");
  } else if (section == "Nodes") {
    is_4 ? read_msh4_nodes(in, out) : read_msh2_nodes(in, out);
  } else if (section == "Elements") {
    is_4 ? read_msh4_elements(in, out) : read_msh2_elements(in, out);
  } else {
    in.skip_section(section);
  }
}

/// Reads all sections.  Elements come behind all that they need, and their values behind them.
MshContent read_content(const ByteSource& source) {
  MshInput in(source);
  const bool is_4 = read_format(in);
  MshContent out(source.name());
  bool nodes = false;
  while (true) {
    const std::string section = in.next_section();
    if (section.empty()) in.fail("truncated: no $Elements");
    if (section == "Nodes" && nodes) in.fail("a second $Nodes");
    nodes = nodes || section == "Nodes";
    read_section(section, is_4, in, out);
    if (section == "Elements") break;
  }
  if (!nodes) in.fail("no $Nodes before $Elements");
  if (out.mesh.tet_count() == 0 && out.elements > 0) in.fail("no element is a tetrahedron");
  read_msh_values(in, out);
  return out;
}

/// Turns marks into labels.
void name_labels(MshContent& content, NumberedLabels& labels) {
  std::map<std::int64_t, RawLabel> known;
  for (RawLabel& mark : content.mesh.marks()) {
    const auto number = static_cast<std::int64_t>(mark);
    auto found = known.find(number);
    if (found == known.end()) {
      const auto physical = content.physical_of.find(number);
      const bool in_group = physical != content.physical_of.end();
      found = known.emplace(number, labels.label(in_group ? physical->second : number)).first;
    }
    mark = found->second;
  }
}

/// Returns the names of labels without those that the writer made up (GroupNames).
LabelNames names_of(const MshContent& content) {
  std::vector<LabelName> rows;
  for (const auto& [number, name] : content.names) {
    if (name == text("label_", number) || name == text("LABEL_", number)) continue;
    if (content.record.cohesive.any() && name.starts_with(kWedgeNames)) continue;
    rows.push_back({.label = static_cast<RawLabel>(number), .name = name, .colour = {}});
  }
  return LabelNames(std::move(rows));
}

}  // namespace

MeshData read_msh(const std::filesystem::path& path) {
  MshContent content = read_content(*open_bytes(path));
  NumberedLabels labels(path);
  name_labels(content, labels);
  MeshData mesh = content.mesh.finish();
  mesh.labels_signed = labels.labels_signed();
  mesh.record = std::move(content.record);
  mesh.values = std::move(content.values);
  name_values(mesh.values);
  mesh.names = labels.has_table() ? labels.names() : names_of(content);
  return mesh;
}

void TaggedMesh::add_tet(std::span<const std::uint64_t> tags, RawLabel mark) {
  mesh_.tets.push_back({tags[0], tags[1], tags[2], tags[3]});
  mesh_.labels.push_back(mark);
  middles_.insert(middles_.end(), tags.begin() + 4, tags.end());
}

MeshData TaggedMesh::finish() {
  sort_nodes();
  for (TetRows& tet : mesh_.tets) {
    for (std::uint64_t& corner : tet) corner = row_of(corner);
  }
  KeptRows middles(nodes_.size());
  for (const std::uint64_t tag : middles_) middles.middle(row_of(tag));
  middles_ = {};
  mesh_.vertices.reserve(nodes_.size());
  for (const Node& node : nodes_) mesh_.vertices.push_back(node.position);
  nodes_ = {};
  mesh_.ten_nodes = middles.any();
  drop_middles(mesh_, middles);
  return std::move(mesh_);
}

void TaggedMesh::sort_nodes() {
  const auto comes_before = [](const Node& a, const Node& b) { return a.tag < b.tag; };
  std::sort(nodes_.begin(), nodes_.end(), comes_before);
  const auto twice = std::adjacent_find(
      nodes_.begin(), nodes_.end(), [](const Node& a, const Node& b) { return a.tag == b.tag; });
  if (twice == nodes_.end()) return;
  fail_input(file_, "nodes", text("number ", twice->tag, " is there twice"),
             "save the mesh as one part, each node with a number of its own");
}

std::uint64_t TaggedMesh::row_of(std::uint64_t tag) const {
  const auto found =
      std::lower_bound(nodes_.begin(), nodes_.end(), tag,
                       [](const Node& node, std::uint64_t wanted) { return node.tag < wanted; });
  if (found != nodes_.end() && found->tag == tag) {
    return static_cast<std::uint64_t>(found - nodes_.begin());
  }
  fail_input(file_, "elements", text("one names node ", tag, ", which is not in the file"),
             "write the mesh anew");
}

}  // namespace mw::io
