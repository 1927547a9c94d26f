// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of dimensions, variables and attributes are those of the Exodus II manual (SAND92-2137).
#include "io/mesh/exodus/exodus_writer.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "io/file/errors.h"
#include "io/mesh/grouped/group_names.h"

namespace mw::io {
namespace {

constexpr std::size_t kNameBytes = 80;
constexpr std::size_t kRowsAtOnce = 4096;

/// Returns the side of an element that lies opposite to a corner.
int side_opposite(std::uint64_t corner) {
  constexpr std::array<int, 4> kSides{2, 3, 1, 4};
  return kSides[corner];
}

int number(std::uint64_t row) {
  return static_cast<int>(row + 1);
}

std::vector<int> counted_from_one(int count) {
  std::vector<int> out(static_cast<std::size_t>(count));
  std::iota(out.begin(), out.end(), 1);
  return out;
}

/// Calls visit(first, count) on a range in steps.
template <class Visit>
void in_steps(RowRange rows, Visit visit) {
  for (std::uint64_t first = rows.begin; first < rows.end; first += kRowsAtOnce) {
    visit(first, std::min<std::uint64_t>(kRowsAtOnce, rows.end - first));
  }
}

}  // namespace

void ExodusWriter::write(GroupedMesh& mesh) {
  check_number(name_, std::max(mesh.node_count(), mesh.tet_count() + mesh.wedge_count()),
               {.max = std::numeric_limits<int>::max(),
                .subject = "nodes and tets have",
                .others = ".vtkhdf"});
  const auto wedge_blocks = static_cast<std::int64_t>(mesh.wedge_groups().size());
  const LabelNumbers numbers(mesh.table(), {.max = std::numeric_limits<int>::max() - wedge_blocks});
  if (rule_) materials_.emplace(mesh, *rule_);
  Plan plan = plan_of(mesh, numbers);
  define(mesh, plan);
  out_.begin_data();
  write_block_list(mesh, plan);
  write_nodes(mesh, plan);
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    write_block(mesh, mesh.label_tets()[rank], plan.connectivity[rank]);
  }
  write_wedges(mesh, plan);
  write_values(mesh, plan);
  write_facet_sets(mesh, plan);
  write_element_sets(plan);
  append_label_table(labels_, mesh.table(), mesh.header(), numbers);
  table_ ? out_.commit(labels_, *table_) : out_.commit(labels_);
}

template <class Visit>
void ExodusWriter::for_each_side_set(const GroupedMesh& mesh, const PlainNames& names,
                                     Visit visit) {
  int id = 0;
  for_each_named(mesh, names, [&](const NamedFacets& set) {
    visit(FacetSet{.name = set.name, .facets = set.group.facets, .id = ++id});
    if (set.other.empty()) return;
    visit(FacetSet{.name = set.other,
                   .facets = set.group.facets,
                   .id = ++id,
                   .of_second = true,
                   .has_nodes = set.is_split});
  });
}

template <class Visit>
void ExodusWriter::for_each_node_set(const GroupedMesh& mesh, const PlainNames& names,
                                     Visit visit) {
  for_each_side_set(mesh, names, [&](const FacetSet& set) {
    if (set.has_nodes) visit(set);
  });
}

ExodusWriter::Plan ExodusWriter::plan_of(const GroupedMesh& mesh,
                                         const LabelNumbers& numbers) const {
  Plan plan{.names = PlainNames(mesh)};
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    plan.ids.push_back(static_cast<int>(numbers[rank]));
  }
  for (std::size_t g = 1; g <= mesh.wedge_groups().size(); ++g) {
    plan.ids.push_back(static_cast<int>(numbers.largest() + static_cast<std::int64_t>(g)));
  }
  for_each_side_set(mesh, plan.names,
                    [&](const FacetSet& set) { plan.side_sets.push_back(set.id); });
  for_each_node_set(mesh, plan.names,
                    [&](const FacetSet& set) { plan.node_sets.push_back(set.id); });
  plan_element_sets(mesh, plan);
  return plan;
}

/// Plans sets of masks, then those of materials.
void ExodusWriter::plan_element_sets(const GroupedMesh& mesh, Plan& plan) const {
  for (const MaskGroup& mask : mask_groups(mesh)) {
    ElementSet set{.name = plan.names.mask(plan.element_sets.size())};
    for (const Label rank : mask.ranks) {
      set.of_labels.push_back(mesh.label_tets()[rank]);
      set.tets += set.of_labels.back().size();
    }
    plan.element_sets.push_back(std::move(set));
  }
  for (std::uint32_t m = 1; materials_ && m <= materials_->count(); ++m) {
    const std::uint64_t tets = materials_->facts(m).tets;
    if (tets == 0) continue;
    plan.element_sets.push_back({.name = materials_->name(m), .tets = tets, .material = m});
  }
}

void ExodusWriter::define(GroupedMesh& mesh, Plan& plan) {
  constexpr float kVersion = 8.03F;
  constexpr int kLargeModel = 1;
  constexpr int kBytesOfDouble = 8;
  out_.add_attribute(NetcdfOutput::kWholeFile, "api_version", kVersion);
  out_.add_attribute(NetcdfOutput::kWholeFile, "version", kVersion);
  out_.add_attribute(NetcdfOutput::kWholeFile, "floating_point_word_size", kBytesOfDouble);
  out_.add_attribute(NetcdfOutput::kWholeFile, "file_size", kLargeModel);
  out_.add_attribute(NetcdfOutput::kWholeFile, "maximum_name_length", static_cast<int>(kNameBytes));
  out_.add_attribute(NetcdfOutput::kWholeFile, "title",
                     text("mwmesh: tetrahedra of ", mesh.table().size(), " labels"));
  name_length_ = out_.add_dimension("len_name", kNameBytes + 1);
  out_.add_dimension("num_dim", 3);
  // Without values there are no steps; length 0 means that some may be added.
  time_step_ = out_.add_dimension("time_step", mesh.header().values.empty() ? 0 : 1);
  if (mesh.node_count() > 0) {
    const int nodes = out_.add_dimension("num_nodes", mesh.node_count());
    plan.coordinates = {out_.add_doubles("coordx", {nodes}), out_.add_doubles("coordy", {nodes}),
                        out_.add_doubles("coordz", {nodes})};
  }
  const std::uint64_t elements = mesh.tet_count() + mesh.wedge_count();
  if (elements > 0) out_.add_dimension("num_elem", elements);
  block_list_ = define_list("num_el_blk", "eb_", plan.ids.size());
  define_values(mesh, plan, define_blocks(mesh, plan));
  define_facet_sets(mesh, plan);
  define_element_sets(plan);
}

void ExodusWriter::define_facet_sets(GroupedMesh& mesh, Plan& plan) {
  int number = 0;
  side_set_list_ = define_list("num_side_sets", "ss_", plan.side_sets.size());
  for_each_side_set(mesh, plan.names, [&](const FacetSet& set) {
    ++number;
    const int sides = out_.add_dimension(text("num_side_ss", number), set.facets.size());
    const int elements = out_.add_integers(text("elem_ss", number), {sides});
    if (number == 1) plan.side_variable = elements;
    out_.add_integers(text("side_ss", number), {sides});
  });
  number = 0;
  node_set_list_ = define_list("num_node_sets", "ns_", plan.node_sets.size());
  for_each_node_set(mesh, plan.names, [&](const FacetSet& set) {
    ++number;
    std::uint64_t count = 0;
    for_each_facet_node(
        mesh, set.facets, [&](std::uint64_t /*row*/) { ++count; }, set.of_second);
    const int nodes = out_.add_dimension(text("num_nod_ns", number), count);
    const int variable = out_.add_integers(text("node_ns", number), {nodes});
    if (number == 1) plan.node_variable = variable;
  });
}

std::vector<int> ExodusWriter::define_blocks(const GroupedMesh& mesh, Plan& plan) {
  const bool quadratic = has_middles(mesh.element());
  std::vector<int> out;
  for (std::size_t b = 0; b < plan.ids.size(); ++b) {
    const bool has_tets = b < mesh.table().size();
    const RowRange range =
        has_tets ? mesh.label_tets()[b] : mesh.wedge_groups()[b - mesh.table().size()].wedges;
    const std::uint64_t nodes =
        has_tets ? node_count(mesh.element()) : wedge_node_count(Element::kTet4);
    out.push_back(out_.add_dimension(text("num_el_in_blk", b + 1), range.size()));
    const int columns = out_.add_dimension(text("num_nod_per_el", b + 1), nodes);
    plan.connectivity.push_back(out_.add_integers(text("connect", b + 1), {out.back(), columns}));
    const char* const of_tets = quadratic ? "TETRA10" : "TETRA";
    out_.add_attribute(plan.connectivity.back(), "elem_type", has_tets ? of_tets : "WEDGE");
  }
  return out;
}

void ExodusWriter::define_element_sets(Plan& plan) {
  element_set_list_ = define_list("num_elem_sets", "els_", plan.element_sets.size());
  for (std::size_t s = 0; s < plan.element_sets.size(); ++s) {
    ElementSet& set = plan.element_sets[s];
    const int tets = out_.add_dimension(text("num_ele_els", s + 1), set.tets);
    set.variable = out_.add_integers(text("elem_els", s + 1), {tets});
  }
}

void ExodusWriter::write_element_sets(const Plan& plan) {
  write_list(element_set_list_, counted_from_one(static_cast<int>(plan.element_sets.size())));
  for (std::size_t i = 0; i < plan.element_sets.size(); ++i) {
    out_.put_text(element_set_list_.names, i, plan.element_sets[i].name, kNameBytes);
  }
  write_masks(plan);
  if (materials_) write_materials(plan);
}

void ExodusWriter::write_masks(const Plan& plan) {
  for (const ElementSet& set : plan.element_sets) {
    std::uint64_t written = 0;
    for (const RowRange& range : set.of_labels) {
      in_steps(range, [&](std::uint64_t first, std::uint64_t count) {
        std::vector<int> tets(count);
        std::iota(tets.begin(), tets.end(), number(first));
        out_.put(set.variable, written, tets);
        written += count;
      });
    }
  }
}

void ExodusWriter::write_materials(const Plan& plan) {
  std::vector<int> tets;
  std::uint64_t written = 0;
  auto set = std::ranges::find_if(plan.element_sets,
                                  [](const ElementSet& each) { return each.material != 0; });
  const auto flush = [&] {
    if (!tets.empty()) out_.put(set->variable, written, tets);
    written += tets.size();
    tets.clear();
  };
  materials_->for_each([&](std::uint32_t material, std::uint64_t tet) {
    if (material != set->material) {
      flush();
      ++set;  // those without tets are not in the plan
      written = 0;
    }
    tets.push_back(number(tet));
    if (tets.size() == kRowsAtOnce) flush();
  });
  flush();
  materials_->append_table(*table_);
}

/// Defines the variables of elements, which have one step at time 0.
void ExodusWriter::define_values(const GroupedMesh& mesh, Plan& plan,
                                 const std::vector<int>& elements) {
  const std::size_t count = mesh.header().values.size();
  if (count == 0) return;
  plan.time = out_.add_doubles("time_whole", {time_step_});
  plan.value_names =
      out_.add_texts("name_elem_var", {out_.add_dimension("num_elem_var", count), name_length_});
  for (std::size_t v = 0; v < count; ++v) {
    plan.values.emplace_back();
    for (std::size_t b = 0; b < elements.size(); ++b) {
      plan.values[v].push_back(
          out_.add_doubles(text("vals_elem_var", v + 1, "eb", b + 1), {time_step_, elements[b]}));
    }
  }
}

ExodusWriter::ListVariables ExodusWriter::define_list(const std::string& dimension,
                                                      const std::string& prefix,
                                                      std::size_t members) {
  if (members == 0) return {};
  const int length = out_.add_dimension(dimension, members);
  ListVariables list;
  list.status = out_.add_integers(prefix + "status", {length});
  list.ids = out_.add_integers(prefix + "prop1", {length});
  out_.add_attribute(list.ids, "name", std::string("ID"));
  list.names = out_.add_texts(prefix + "names", {length, name_length_});
  return list;
}

void ExodusWriter::write_list(const ListVariables& list, std::span<const int> ids) {
  if (ids.empty()) return;
  out_.put(list.status, 0, std::vector<int>(ids.size(), 1));
  out_.put(list.ids, 0, ids);
}

void ExodusWriter::write_block_list(const GroupedMesh& mesh, const Plan& plan) {
  write_list(block_list_, plan.ids);
  std::size_t block = 0;
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    out_.put_text(block_list_.names, block++, plan.names.volume(rank), kNameBytes);
  }
  for (const WedgeGroup& group : mesh.wedge_groups()) {
    out_.put_text(block_list_.names, block++, plan.names.wedges(group), kNameBytes);
  }
}

void ExodusWriter::write_nodes(GroupedMesh& mesh, const Plan& plan) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    in_steps({0, mesh.node_count()}, [&](std::uint64_t first, std::uint64_t count) {
      std::vector<double> values(count);
      for (std::uint64_t i = 0; i < count; ++i) values[i] = mesh.node(first + i)[axis];
      out_.put(plan.coordinates[axis], first, values);
    });
  }
}

void ExodusWriter::write_values(GroupedMesh& mesh, const Plan& plan) {
  for (std::size_t v = 0; v < plan.values.size(); ++v) {
    out_.put_text(plan.value_names, v, mesh.header().values[v], kNameBytes);
    for (Label rank = 0; rank < mesh.table().size(); ++rank) {
      const RowRange tets = mesh.label_tets()[rank];
      in_steps(tets, [&](std::uint64_t first, std::uint64_t count) {
        std::vector<double> values(count);
        for (std::uint64_t i = 0; i < count; ++i) values[i] = mesh.value(first + i, v);
        out_.put(plan.values[v][rank], first - tets.begin, values);
      });
    }
    for (std::size_t g = 0; g < mesh.wedge_groups().size(); ++g) {
      const RowRange wedges = mesh.wedge_groups()[g].wedges;
      in_steps(wedges, [&](std::uint64_t first, std::uint64_t count) {
        std::vector<double> values(count);
        for (std::uint64_t i = 0; i < count; ++i) {
          values[i] = mesh.value(mesh.wedge(first + i).bottom_tet, v);
        }
        out_.put(plan.values[v][mesh.table().size() + g], first - wedges.begin, values);
      });
    }
  }
}

void ExodusWriter::write_block(GroupedMesh& mesh, RowRange tets, int variable) {
  const std::size_t columns = node_count(mesh.element());
  in_steps(tets, [&](std::uint64_t first, std::uint64_t count) {
    std::vector<int> values;
    values.reserve(count * columns);
    for (std::uint64_t t = first; t < first + count; ++t) {
      for (const std::uint64_t row : mesh.tet_nodes(t)) values.push_back(number(row));
    }
    out_.put(variable, first - tets.begin, values, columns);
  });
}

void ExodusWriter::write_wedges(GroupedMesh& mesh, const Plan& plan) {
  const std::size_t columns = wedge_node_count(Element::kTet4);
  for (std::size_t g = 0; g < mesh.wedge_groups().size(); ++g) {
    const RowRange wedges = mesh.wedge_groups()[g].wedges;
    in_steps(wedges, [&](std::uint64_t first, std::uint64_t count) {
      std::vector<int> values;
      values.reserve(count * columns);
      for (std::uint64_t w = first; w < first + count; ++w) {
        for (const std::uint64_t row : mesh.wedge_nodes(mesh.wedge(w))) {
          values.push_back(number(row));
        }
      }
      out_.put(plan.connectivity[mesh.table().size() + g], first - wedges.begin, values, columns);
    });
  }
}

void ExodusWriter::write_facet_sets(GroupedMesh& mesh, const Plan& plan) {
  constexpr int kOfSideSet = 2;  // variables
  write_list(side_set_list_, plan.side_sets);
  write_list(node_set_list_, plan.node_sets);
  int at = 0;
  for_each_side_set(mesh, plan.names, [&](const FacetSet& set) {
    out_.put_text(side_set_list_.names, static_cast<std::uint64_t>(at), set.name, kNameBytes);
    write_side_set(mesh, set, plan.side_variable + kOfSideSet * at++);
  });
  at = 0;
  for_each_node_set(mesh, plan.names, [&](const FacetSet& set) {
    out_.put_text(node_set_list_.names, static_cast<std::uint64_t>(at), set.name, kNameBytes);
    write_node_set(mesh, set, plan.node_variable + at++);
  });
}

/// Writes the elements into the variable, and their sides into the next one.
void ExodusWriter::write_side_set(GroupedMesh& mesh, const FacetSet& set, int variable) {
  in_steps(set.facets, [&](std::uint64_t first, std::uint64_t count) {
    std::vector<int> elements, sides;
    for (std::uint64_t f = first; f < first + count; ++f) {
      const Facet facet = mesh.facet(f);
      elements.push_back(number(set.of_second ? facet.second_tet : facet.tet));
      sides.push_back(side_opposite(set.of_second ? facet.second_opposite : facet.opposite));
    }
    out_.put(variable, first - set.facets.begin, elements);
    out_.put(variable + 1, first - set.facets.begin, sides);
  });
}

void ExodusWriter::write_node_set(GroupedMesh& mesh, const FacetSet& set, int variable) {
  std::vector<int> nodes;
  std::uint64_t written = 0;
  const auto flush = [&] {
    out_.put(variable, written, nodes);
    written += nodes.size();
    nodes.clear();
  };
  const auto add = [&](std::uint64_t row) {
    nodes.push_back(number(row));
    if (nodes.size() == kRowsAtOnce) flush();
  };
  for_each_facet_node(mesh, set.facets, add, set.of_second);
  flush();
}

}  // namespace mw::io
