// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes sections and numbers, and finds groups with their numbers and names.
#include "io/mesh/gmsh/msh_common.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>

#include "io/file/byte_order.h"
#include "io/file/errors.h"
#include "io/mesh/grouped/group_names.h"
#include "io/mesh/grouped/plain_names.h"

namespace mw::io {
namespace {

std::int32_t above(const LabelNumbers& labels, std::size_t number) {
  return static_cast<std::int32_t>(labels.largest() + static_cast<std::int64_t>(number));
}

/// Gmsh knows no way to write a quote.
std::string without_quotes(std::string name) {
  std::replace(name.begin(), name.end(), '"', '\'');
  return name;
}

/// Gmsh documents this limit.
constexpr std::size_t kMaxNameBytesOfGmsh = 127;

/// True if the group is the first one of its name: all labels share that of a side.
bool begins_name(const FacetGroups& groups, std::size_t g) {
  return g == 0 || groups[g].side == Side::kInterface || groups[g].side != groups[g - 1].side;
}

std::int32_t mask_volume(const LabelNumbers& labels, const GroupedMesh& mesh, std::size_t mask) {
  return above(labels, kSides + mesh.facet_groups().size() + mesh.wedge_groups().size() + mask);
}

std::string name_line(std::int32_t dimension, std::int64_t tag, const std::string& name) {
  return text(dimension, " ", tag, " \"", name, "\"");
}

void write_wedge_names(MshEncoder& out, const GroupedMesh& mesh, const LabelNumbers& labels,
                       const PlainNames& names) {
  for (std::size_t g = 0; g < mesh.wedge_groups().size(); ++g) {
    out.add_line(
        name_line(kMshVolume, wedge_volume(labels, mesh, g), names.wedges(mesh.wedge_groups()[g])));
  }
}

/// Writes a section ElementData, alike in both versions; number_of(tet) is the number of a tet.
template <class NumberOf>
void write_column(MshEncoder& out, GroupedMesh& mesh, const std::string& name, NumberOf number_of) {
  out.begin_section("ElementData");
  out.add_line("1");
  out.add_line(text("\"", name, "\""));
  // These are one time and three integers: its number, the components of a value, the values.
  for (const char* const line : {"1", "0", "3", "0", "1"}) out.add_line(line);
  out.add_line(text(mesh.facet_count() + mesh.tet_count() + mesh.wedge_count()));
  std::uint64_t element = 0;
  const auto put = [&](std::uint64_t tet) {
    ++element;
    out.ascii() ? out.put(element) : out.put(static_cast<std::int32_t>(element));
    out.put(number_of(tet));
    out.end_row();
  };
  for (std::uint64_t f = 0; f < mesh.facet_count(); ++f) put(mesh.facet(f).tet);
  for (std::uint64_t t = 0; t < mesh.tet_count(); ++t) put(t);
  for (std::uint64_t w = 0; w < mesh.wedge_count(); ++w) put(mesh.wedge(w).bottom_tet);
  out.end_section("ElementData");
}

}  // namespace

LabelNumbers msh_numbers(const GroupedMesh& mesh) {
  const auto others = static_cast<std::int64_t>(
      kSides + mesh.facet_groups().size() + mesh.wedge_groups().size() + mask_groups(mesh).size());
  return LabelNumbers(mesh.table(), {.max = std::numeric_limits<std::int32_t>::max() - others});
}

std::int32_t surface_tag(const LabelNumbers& labels, std::size_t group) {
  return above(labels, group + 1);
}

/// Interfaces are the first groups.
std::int32_t physical_surface(const LabelNumbers& labels, const FacetGroup& group,
                              std::size_t index) {
  const bool interface = group.side == Side::kInterface;
  return above(labels, interface ? kSides + index : static_cast<std::size_t>(group.side));
}

std::int32_t wedge_volume(const LabelNumbers& labels, const GroupedMesh& mesh, std::size_t group) {
  return above(labels, kSides + mesh.facet_groups().size() + group);
}

std::vector<std::vector<std::int32_t>> mask_volumes(const LabelNumbers& labels,
                                                    const GroupedMesh& mesh) {
  std::vector<std::vector<std::int32_t>> out(mesh.table().size());
  std::size_t number = 0;
  for (const MaskGroup& mask : mask_groups(mesh)) {
    const std::int32_t volume = mask_volume(labels, mesh, number++);
    for (const Label rank : mask.ranks) out[rank].push_back(volume);
  }
  return out;
}

void write_record(MshEncoder& out, const GroupedMesh& mesh) {
  const MeshRecord& record = mesh.header().record;
  if (mesh.wedge_groups().empty() && !record.curved && record.masks.empty()) return;
  out.begin_section("Comments");
  out.add_line(kMshRecord, record_text(record));
  out.add_line("$EndComments");
}

void write_physical_names(MshEncoder& out, const GroupedMesh& mesh, const LabelNumbers& labels,
                          MshNames style) {
  const bool is_plain = style == MshNames::kPlain;
  const GroupNames names(mesh, without_quotes, kMaxNameBytesOfGmsh);
  std::optional<PlainNames> plain;
  if (is_plain || !mesh.wedge_groups().empty()) {
    plain.emplace(mesh, NameRule{.max_bytes = kMaxNameBytesOfGmsh});
  }
  const FacetGroups& groups = mesh.facet_groups();
  const std::size_t masks = is_plain ? 0 : mask_groups(mesh).size();
  std::size_t count = mesh.table().size() + mesh.wedge_groups().size() + masks;
  for (std::size_t g = 0; g < groups.size(); ++g) count += begins_name(groups, g) ? 1U : 0U;
  out.begin_section("PhysicalNames");
  out.add_line(text(count));
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (!begins_name(groups, g)) continue;
    const bool has_marks = groups[g].side == Side::kInterface;  // "liver|kidney"
    std::string name = is_plain && has_marks ? plain->facets(groups[g]) : names.facets(groups[g]);
    if (name.size() > kMaxNameBytesOfGmsh) name = plain_facet_name(mesh.table(), groups[g]);
    out.add_line(name_line(kMshSurface, physical_surface(labels, groups[g], g), name));
  }
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    const std::string& name = is_plain ? plain->volume(rank) : names.volume(rank);
    out.add_line(name_line(kMshVolume, labels[rank], name));
  }
  if (plain) write_wedge_names(out, mesh, labels, *plain);
  for (std::size_t i = 0; i < masks; ++i) {
    out.add_line(name_line(kMshVolume, mask_volume(labels, mesh, i), names.mask(i)));
  }
  out.add_line("$EndPhysicalNames");
}

void check_element_data(const MshEncoder& out, std::uint64_t elements) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::int32_t>::max();
  if (out.ascii() || elements <= kMost) return;
  fail_usage(out.name(), ": values of elements have numbers up to ", kMost, " in binary, ",
             elements, " are needed; write text (--ascii) or .vtkhdf");
}

void write_element_data(MshEncoder& out, GroupedMesh& mesh) {
  const std::vector<std::string>& names = mesh.header().values;
  for (std::size_t column = 0; column < names.size(); ++column) {
    write_column(out, mesh, names[column],
                 [&](std::uint64_t tet) { return mesh.value(tet, column); });
  }
}

MshTables::MshTables(const std::filesystem::path& mesh, std::optional<MaterialRule> rule)
    : labels_(label_table_path(mesh)), rule_(std::move(rule)) {
  if (rule_) materials_.emplace(material_table_path(mesh));
}

void MshTables::write_with(MshEncoder& out, GroupedMesh& mesh, const LabelNumbers& numbers) {
  append_label_table(labels_, mesh.table(), mesh.header(), numbers);
  if (!rule_) return commit_together({labels_, out.file()});
  MaterialSets sets(mesh, *rule_);
  write_column(out, mesh, rule_->values + "_material",
               [&](std::uint64_t tet) { return static_cast<double>(sets.material_of(tet)); });
  sets.append_table(*materials_);
  commit_together({labels_, *materials_, out.file()});
}

void MshEncoder::end_section(std::string_view name) {
  if (!ascii_) file_.append("\n");
  add_line("$End", name);
}

template <class T>
void MshEncoder::add(T number) {
  std::array<char, 32> bytes{};
  if (ascii_) {
    const char* end = std::to_chars(bytes.data(), bytes.data() + bytes.size(), number).ptr;
    row_.append(bytes.data(), static_cast<std::size_t>(end - bytes.data()));
    row_ += ' ';
    return;
  }
  store_little(number, reinterpret_cast<std::byte*>(bytes.data()));
  row_.append(bytes.data(), sizeof number);
}

void MshEncoder::put(std::int32_t number) {
  add(number);
}

void MshEncoder::put(std::uint64_t number) {
  add(number);
}

void MshEncoder::put(double number) {
  add(number);
}

void MshEncoder::end_row() {
  if (ascii_ && !row_.empty()) row_.back() = '\n';
  file_.append(row_);
  row_.clear();
}

}  // namespace mw::io
