// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What .msh files of both versions have in common: sections and numbers, written as text or as
// bytes, types of elements, and numbers and names of groups.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/sink/atomic_file.h"
#include "io/mesh/grouped/grouped_mesh.h"
#include "io/mesh/grouped/label_numbers.h"
#include "io/mesh/grouped/material_sets.h"
#include "io/mesh/mesh_extras.h"

namespace mw::io {

/// Puts numbers in rows, each a line in text; binary (little-endian) has nothing between rows.
/// ERRORS: see AtomicFile.
class MshEncoder {
 public:
  MshEncoder(const std::filesystem::path& path, bool ascii)
      : file_(path), name_(path.string()), ascii_(ascii) {}

  [[nodiscard]] bool ascii() const { return ascii_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Adds a line such as "$Nodes".
  void begin_section(std::string_view name) { add_line("$", name); }
  /// Adds a line such as "$EndNodes".
  void end_section(std::string_view name);
  /// Adds a line, which is text in either kind of file.
  void add_line(std::string_view line, std::string_view more = {}) {
    file_.append_line(line, more);
  }

  /// Puts a number, which has 4 bytes in binary.
  void put(std::int32_t number);
  /// Put a number, which has 8 bytes in binary.
  void put(std::uint64_t number);
  void put(double number);
  void end_row();

  /// Returns the file, which is to be committed with others.
  [[nodiscard]] AtomicFile& file() { return file_; }

 private:
  template <class T>
  void add(T number);

  AtomicFile file_;
  std::string name_;
  std::string row_;
  bool ascii_;
};

/// The dimensions of groups.
inline constexpr std::int32_t kMshSurface = 2;
inline constexpr std::int32_t kMshVolume = 3;
/// Where the nodes of a tet stand in the file: Gmsh has the middle of edge 2 3 before that of 1 3.
inline constexpr std::array<std::size_t, 10> kMshTetOrder{0, 1, 2, 3, 4, 5, 6, 7, 9, 8};

/// The beginning of a comment that holds a MeshRecord.
inline constexpr std::string_view kMshRecord = "mwmesh ";

/// Returns the numbers of volumes.  Surfaces have numbers above them, because many programs have
/// one space of numbers for all dimensions.  ERRORS: see LabelNumbers.
[[nodiscard]] LabelNumbers msh_numbers(const GroupedMesh& mesh);

/// Returns the tag of the surface that is facet group number `group`.
[[nodiscard]] std::int32_t surface_tag(const LabelNumbers& labels, std::size_t group);

/// Returns the physical surface that facet group number `index` belongs to.
[[nodiscard]] std::int32_t physical_surface(const LabelNumbers& labels, const FacetGroup& group,
                                            std::size_t index);

/// Returns the tag and physical group, above all others, of the volume that is this wedge group.
[[nodiscard]] std::int32_t wedge_volume(const LabelNumbers& labels, const GroupedMesh& mesh,
                                        std::size_t group);

/// Returns the physical volumes, above all others, of the masks that have each label, by rank.
[[nodiscard]] std::vector<std::vector<std::int32_t>> mask_volumes(const LabelNumbers& labels,
                                                                  const GroupedMesh& mesh);

/// Writes a section of comments with the record of the run, where the mesh has curved tets, wedges
/// or masks, which could not be found again without it.
void write_record(MshEncoder& out, const GroupedMesh& mesh);

/// How a version of the format names its groups.
enum class MshNames {
  kForPeople,  ///< as GroupNames; those of masks, too, as an element may have several
  kPlain,      ///< as PlainNames, for gmshToFoam and others that take no blanks and marks
};

/// Writes the section of the names of all physical surfaces and volumes (see write_msh()).
void write_physical_names(MshEncoder& out, const GroupedMesh& mesh, const LabelNumbers& labels,
                          MshNames style);

/// The files beside a .msh, and the numbers of materials in it.
class MshTables {
 public:
  MshTables(const std::filesystem::path& mesh, std::optional<MaterialRule> rule);

  /// Writes the section of materials, if there are any, and the tables, and commits all.
  void write_with(MshEncoder& out, GroupedMesh& mesh, const LabelNumbers& numbers);

 private:
  AtomicFile labels_;
  std::optional<MaterialRule> rule_;
  std::optional<AtomicFile> materials_;
};

/// A mesh that is written, and the files beside it.
struct MshFiles {
  MshFiles(const std::filesystem::path& path, const MeshExtras& extras)
      : out(path, extras.encoding == Encoding::kText || path.extension() == ".msh2"),
        tables(path, extras.materials) {}

  MshEncoder out;
  MshTables tables;
};

/// ERRORS: mw::Error(kUsage) naming the file where this many elements cannot have values, because
/// Gmsh numbers them in 32 bits there, in binary.
void check_element_data(const MshEncoder& out, std::uint64_t elements);

/// Writes a section ElementData for each of the values of tets, alike in both versions.  A triangle
/// or a wedge has the value of the tet behind it, because meshio reads no data that only some
/// elements have.
void write_element_data(MshEncoder& out, GroupedMesh& mesh);

inline constexpr std::int32_t kMshTriangle3 = 2;
inline constexpr std::int32_t kMshTet4 = 4;
inline constexpr std::int32_t kMshPrism6 = 6;
inline constexpr std::int32_t kMshTriangle6 = 9;
inline constexpr std::int32_t kMshTet10 = 11;

/// The number of nodes of each element type from 0 on, as Gmsh's manual numbers them: lines,
/// triangles, quadrangles, tets, hexahedra, prisms, pyramids and points of orders up to 5.
inline constexpr std::array<std::uint8_t, 32> kMshNodes{0,  2,  3,  4,  4, 8, 6,  5,  3,  6, 9,
                                                        10, 27, 18, 14, 1, 8, 20, 15, 13, 9, 10,
                                                        12, 15, 15, 21, 4, 5, 6,  20, 35, 56};

/// Returns how many nodes an element of the type has, or 0 for types not known here.
[[nodiscard]] inline std::uint64_t msh_nodes_of(std::int64_t type) {
  constexpr std::int64_t kHexahedron64 = 92, kHexahedron125 = 93;
  if (type == kHexahedron64) return 64;
  if (type == kHexahedron125) return 125;
  return type > 0 && type < std::ssize(kMshNodes) ? kMshNodes[static_cast<std::size_t>(type)] : 0;
}

/// True for tets of any order, whose first four nodes are their corners.
[[nodiscard]] inline bool is_msh_tet(std::int64_t type) {
  constexpr std::int64_t kTet20 = 29, kTet56 = 31;
  return type == kMshTet4 || type == kMshTet10 || (type >= kTet20 && type <= kTet56);
}

}  // namespace mw::io
