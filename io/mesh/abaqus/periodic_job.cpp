// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/mesh/abaqus/periodic_job.h"

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "io/file/errors.h"
#include "io/mesh/grouped/fixed_fields.h"
#include "io/mesh/grouped/periodic_pairs.h"

namespace mw::io {
namespace {

constexpr unsigned kAllAxes = 7;
constexpr int kTemperature = 11;  // a degree of freedom of CalculiX

/// A load, and how each reference node moves: what the load makes of the edge of its axis.
struct Load {
  std::string_view name;
  std::array<std::array<double, 3>, 3> tensor{};  ///< rows by degree of freedom
};

constexpr std::array<Load, 6> kStrains{Load{"strain xx", {{{1, 0, 0}, {0, 0, 0}, {0, 0, 0}}}},
                                       Load{"strain yy", {{{0, 0, 0}, {0, 1, 0}, {0, 0, 0}}}},
                                       Load{"strain zz", {{{0, 0, 0}, {0, 0, 0}, {0, 0, 1}}}},
                                       Load{"shear yz", {{{0, 0, 0}, {0, 0, 0.5}, {0, 0.5, 0}}}},
                                       Load{"shear xz", {{{0, 0, 0.5}, {0, 0, 0}, {0.5, 0, 0}}}},
                                       Load{"shear xy", {{{0, 0.5, 0}, {0.5, 0, 0}, {0, 0, 0}}}}};
constexpr std::array<Load, 3> kGradients{Load{"gradient along x", {{{1, 0, 0}}}},
                                         Load{"gradient along y", {{{0, 1, 0}}}},
                                         Load{"gradient along z", {{{0, 0, 1}}}}};

/// What differs between the two jobs.
struct Job {
  std::vector<int> freedoms;
  std::vector<std::string_view> step;  ///< cards that begin a step
  std::string_view printed;            ///< what elements print
  std::span<const Load> loads;
};

Job job_of(Deck deck) {
  if (deck == Deck::kPeriodic) return {{1, 2, 3}, {"*STATIC"}, "S", kStrains};
  return {{kTemperature}, {"*HEAT TRANSFER, STEADY STATE"}, "HFL", kGradients};
}

/// Returns the number of a node that no equation gives a value.
std::uint64_t free_node(const GroupedMesh& mesh, const PeriodicPairs& found) {
  std::uint64_t row = 0;
  for (const PeriodicPair& p : found.pairs) {
    if (p.node == row) ++row;
  }
  if (row >= mesh.node_count()) fail_usage("--deck: all nodes are images of others");
  return row + 1;
}

void write_box(AtomicFile& file, const MeshBox& box) {
  std::string line = "** CELL";
  const auto add = [&line](const Position& p) {
    for (const double x : p) line += " " + inp_real(x);
  };
  add(box.origin);
  for (const Position& edge : box.edges) add(edge);
  file.append_line(line);
}

void write_step(AtomicFile& file, const GroupedMesh& mesh, const Job& job, const Load& load,
                const std::array<std::uint64_t, 3>& references) {
  file.append_line(text("** ", load.name));
  file.append_line("*STEP");
  for (const std::string_view card : job.step) file.append_line(card);
  file.append_line("*BOUNDARY");
  for (std::size_t k = 0; k < references.size(); ++k) {
    const Position& edge = mesh.box().edges[k];
    for (std::size_t i = 0; i < job.freedoms.size(); ++i) {
      const auto& row = load.tensor[i];
      const double value = row[0] * edge[0] + row[1] * edge[1] + row[2] * edge[2];
      file.append_line(
          text(references[k], ", ", job.freedoms[i], ", ", job.freedoms[i], ", ", inp_real(value)));
    }
  }
  file.append_line("*EL PRINT, ELSET=", kAllElements);
  file.append_line(job.printed);
  file.append_line("*END STEP");
}

}  // namespace

void write_periodic_job(AtomicFile& file, GroupedMesh& mesh, const std::string& name, Deck deck) {
  if (recorded_axes(mesh) != kAllAxes) {
    fail_usage(name, ": --deck ", deck == Deck::kPeriodic ? "periodic" : "conduction",
               ": needs a mesh that was made with --periodic xyz");
  }
  const PeriodicPairs found = recorded_pairs(mesh, name);
  const Job job = job_of(deck);
  file.append_line(
      "** Unit loads of a cell that repeats itself; averages over the cell of what elements print "
      "are");
  file.append_line("** the columns of its effective tensor (Python: mwmesh.homogenise).");
  write_box(file, mesh.box());
  const auto references = write_equations(file, mesh, found, job.freedoms);
  file.append_line(text("*ELSET, ELSET=", kAllElements, ", GENERATE"));
  file.append_line(text("1, ", mesh.tet_count(), ", 1"));
  file.append_line("*BOUNDARY");
  file.append_line(
      text(free_node(mesh, found), ", ", job.freedoms.front(), ", ", job.freedoms.back()));
  for (const Load& load : job.loads) write_step(file, mesh, job, load, references);
}

}  // namespace mw::io
