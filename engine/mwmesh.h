// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The C++ library: labelled voxels in, a tetrahedral mesh out.  Standard headers only.
//
//   std::vector<std::uint8_t> labels(64 * 64 * 64);  // x fastest
//   const auto volume = mwmesh::Volume::of(mwmesh::ArrayVolume{
//       .data = labels.data(), .type = mwmesh::VoxelType::kU8, .shape = {64, 64, 64}});
//   const mwmesh::Mesh mesh = mwmesh::mesh(volume, mwmesh::Settings().set("max_distance", "1"));
//   mwmesh::write_mesh(mesh, "mesh.vtu");
//
// Arrays of three are (x, y, z).  Labels are 64-bit numbers; those of signed volumes are in two's
// complement.  All functions may be called by several threads at once, also on the same Volume.
// All of them throw Error.  What callbacks throw passes through, except std::bad_alloc,
// std::length_error and std::filesystem::filesystem_error, which become an Error, too.  Threads
// that call this library must round to nearest and mask all floating-point exceptions, as C++
// programs do unless told otherwise.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#pragma GCC visibility push(default)

namespace mwmesh {

/// Returns the version of the library that is linked, "MAJOR.MINOR.PATCH".
[[nodiscard]] const char* version();

enum class ErrorKind {
  kInternal = 1,     ///< an invariant broke: please report it
  kUsage = 2,        ///< an argument or a setting that makes no sense
  kInput = 3,        ///< a volume or file that is unreadable, damaged or unsupported
  kResource = 4,     ///< memory, disk or threads do not suffice
  kCheckFailed = 5,  ///< the mesh does not pass its own check
  kCancelled = 6,    ///< Hooks::cancel returned true
};

/// What this library throws.  The message names the thing, the reason and the way out.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  [[nodiscard]] ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

using Vector = std::array<double, 3>;
using Index = std::array<std::int64_t, 3>;

/// Voxels from lo to hi, hi not included.
struct Box {
  Index lo{};
  Index hi{};
};

/// The type of a stored label.  Labels that are floats must be whole numbers.
enum class VoxelType { kU8, kU16, kU32, kU64, kI8, kI16, kI32, kI64, kF32, kF64 };

/// Places corners of voxels, counted from the first one: world = origin + sum over i of axes[i] *
/// spacing[i] * corner[i].  Axes have unit length and are at right angles.
struct Space {
  Vector spacing{1, 1, 1};  ///< edges of a voxel, positive
  Vector origin{0, 0, 0};   ///< first corner of the first voxel
  std::array<Vector, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::string unit{};         ///< "mm", "um", "nm" and so on; empty if unknown
  std::string frame = "own";  ///< "own", "ras" or "lps"
};

/// Returns the space of an array whose indices of voxels `affine` (three rows of a 4 x 4 matrix)
/// takes to the world; as in NIfTI, they stand for centres, while the affine of `mwmesh info
/// --json` takes corners, and is to get half of each of its first three columns added to the last.
/// Where all twelve are floats of 32 bits, they are what their shortest decimals say, as in files.
/// frame is "own", "ras" or "lps", or "voxel" to keep nothing but the edges of a voxel.  spacing
/// has these edges where a file states them beside the matrix; it counts for axes that lie along
/// none of the world's, and only where it is that of the matrix to five digits.
/// ERRORS: kInput for numbers that are not finite, for axes that are 0 or not at right angles, and
/// for a spacing that is not positive; kUsage for another frame.
[[nodiscard]] Space space_of_affine(const std::array<std::array<double, 4>, 3>& affine,
                                    const std::string& frame = "own",
                                    const std::optional<Vector>& spacing = {});

struct LabelName {
  std::uint64_t label = 0;
  std::string name{};  ///< may be empty
  /// Red, green, blue and opacity; empty if unknown.
  std::optional<std::array<std::uint8_t, 4>> colour{};
};

/// Reads names and colours from a file as `--names` takes it.  ERRORS: kInput naming file and line.
[[nodiscard]] std::vector<LabelName> read_names(const std::filesystem::path& path);

/// Voxels in memory, which must stay there, unchanged, as long as the Volume and its copies live.
struct ArrayVolume {
  const void* data = nullptr;  ///< address of voxel (0, 0, 0); in the byte order of the machine
  VoxelType type = VoxelType::kU8;
  Index shape{};
  Index strides{};  ///< in bytes, of any sign; all 0 means x fastest, without gaps
  Space space{};
  std::vector<LabelName> names{};
};

/// Voxels that are fetched box by box, so that they need never be in memory together.
struct RegionVolume {
  VoxelType type = VoxelType::kU8;
  Index shape{};
  Index chunk{};  ///< boxes that begin and end at its multiples are cheapest; 0 if all are alike
  Space space{};
  std::vector<LabelName> names{};
  /// Writes the labels of the box, x fastest.  Many threads call it at once, and it is asked for
  /// each voxel about three times.  What it throws ends the run, and so does a label that `type`
  /// cannot hold (kInput).
  std::function<void(const Box& box, std::span<std::uint64_t> out)> read{};
};

/// A file or folder of any format that `mwmesh info` reads, or the address of a remote volume.
struct VolumeFile {
  std::filesystem::path path{};
  std::string dataset{};            ///< an array of the file; if empty, convention chooses one
  std::optional<int> scale{};       ///< level of a pyramid; 0 is the finest
  std::optional<Vector> spacing{};  ///< instead of the file's
  std::optional<Vector> origin{};   ///< instead of the file's
  std::string frame = "file";       ///< world frame: "file", "ras", "lps" or "voxel"
  /// The label of a voxel that is in several masks: "first" or "last" takes that of one of them,
  /// "all" makes a label for each set of masks; if empty, such a voxel is an error.
  std::string overlap{};
  /// Voxels to keep, as the data set counts them: the first one of a store with an offset is that
  /// many voxels from 0 (engine/MANUAL.md).  They stay in place unless origin is given.
  std::optional<Box> crop{};
  bool trust_paths = false;  ///< lets headers name files outside of their own folder
  /// What the numbers are: "labels", "probabilities" (one for each class), or "distances" (one for
  /// each label, signed, negative inside).
  std::string values = "labels";
  /// The labels that matter, or empty if all do.  All others become 0, and the volume ends around
  /// these labels, which are found by coarser scales where there are some (engine/MANUAL.md).
  std::vector<std::uint64_t> object{};
  /// "DIR" or "DIR,SIZE": a folder that keeps what servers send for later runs, and the most bytes
  /// that it may hold (io/FORMATS.md); if empty, nothing is kept.
  std::string cache{};
  /// Which place of a NIfTI file counts, "sform" or "qform"; if empty, the sform where there is
  /// one. Images of Options::sample lie by theirs.
  std::string use_form{};
};

class VolumeAccess;
struct Hooks;

/// A labelled volume, which is cheap to copy.  One that was moved from has nothing in it, and all
/// that is asked of it is kUsage.
class Volume {
 public:
  /// ERRORS: kUsage for an empty or too large shape, or a type or space that makes no sense.
  [[nodiscard]] static Volume of(const ArrayVolume& array);
  [[nodiscard]] static Volume of(const RegionVolume& region);
  /// ERRORS: kInput naming file, field, reason and way out; kUsage for options that do not fit it.
  [[nodiscard]] static Volume open(const VolumeFile& file);
  /// Does the same; hooks.cancel ends waits for a server.
  [[nodiscard]] static Volume open(const VolumeFile& file, const Hooks& hooks);
  /// Returns this volume with these names added; where both name a label, these win.
  [[nodiscard]] Volume with_names(const std::vector<LabelName>& names) const;

  [[nodiscard]] Index shape() const;
  [[nodiscard]] VoxelType type() const;
  [[nodiscard]] Space space() const;
  [[nodiscard]] bool labels_are_signed() const;
  [[nodiscard]] std::vector<LabelName> names() const;
  /// ERRORS: kUsage unless the box is in the volume and out.size() the number of its voxels.
  void read(const Box& box, std::span<std::uint64_t> out) const;

 private:
  friend class VolumeAccess;
  class Content;

  explicit Volume(std::shared_ptr<const Content> content) : content_(std::move(content)) {}

  std::shared_ptr<const Content> content_;
};

/// Returns the label with this number or name: "7", "-1", "Liver".  A number is that label, even if
/// another label is called so.  A name stands for the label whose name is written the same, or else
/// for the one whose name differs in capitals alone; text in double quotes is always a name.
/// ERRORS: kUsage for a number below 0 where labels are not signed, for one of 2^63 or more where
/// they are, and for a name that no label or that several labels have.
[[nodiscard]] std::uint64_t find_label(const Volume& volume, std::string_view text);

/// Returns the text of a setting with numbers in the place of names, "Liver|3=2,*=5".  Names that
/// have one of ",;=" in them must be in double quotes.  ERRORS: those of find_label() for names,
/// and kUsage for a size, which follows the last "=" of a part, that is no finite number.
[[nodiscard]] std::string with_label_numbers(const Volume& volume, std::string_view text);

/// Returns a random volume, x fastest: "voronoi", "tubes", "spheres", "noise" or "checkerboard".
[[nodiscard]] std::vector<std::uint64_t> synth(std::string_view kind, const Index& shape,
                                               std::uint64_t labels, std::uint64_t seed);

/// A setting that the mesh depends on; see `mwmesh mesh --help` for all of them.
struct SettingInfo {
  std::string name{};  ///< "max_distance"
  std::string help{};
  std::string fallback{};              ///< the default
  std::vector<std::string> choices{};  ///< all that it may be; empty for a number or a list
};

/// What the mesh depends on beside the volume.
class Settings {
 public:
  /// Sets a value to a text as on the command line, "1.5", "none", "true", "voxel".
  /// ERRORS: kUsage naming the setting, what it may be, or the names that there are.
  Settings& set(std::string_view name, std::string_view text);
  /// Returns the effective value.  ERRORS: kUsage for a name that does not exist.
  [[nodiscard]] std::string get(std::string_view name) const;
  /// Returns every setting, in the order of the documentation.
  [[nodiscard]] static std::vector<SettingInfo> all();
  /// Returns the values that set() was given, by name.
  [[nodiscard]] const std::map<std::string, std::string>& changed() const { return changed_; }

 private:
  std::map<std::string, std::string> changed_;
};

/// Returns the bytes that "4GiB", "512M", "1.5G" or "4096" stand for.  ERRORS: kUsage.
[[nodiscard]] std::uint64_t bytes_of_text(std::string_view text);

enum class Certify {
  kAuto,  ///< certifies where a quarter of the memory is enough, unless from_kept
  kOn,
  kOff,
};

struct Options {
  /// These steps come before anything else reads the labels: each key of merge becomes its value,
  /// then components of fewer voxels than drop_specks take the label around them.
  std::map<std::uint64_t, std::uint64_t> merge{};
  std::uint64_t drop_specks = 0;  ///< in voxels; 0 drops none
  bool specks_joined_by_corners = false;
  /// The labels of the mesh, or empty for all; the others are meshed but left out.
  std::vector<std::uint64_t> labels{};
  std::optional<std::uint64_t> background{};  ///< the only label that is left out
  /// The parts (tets that faces join) that the mesh keeps: "all", "largest", or the least number of
  /// tets of a part.
  std::string parts = "all";
  /// Interfaces whose vertices are doubled so that they open, "1|2,1|3"; "*" means all.
  std::string split{};
  /// Interfaces, written as in split, that are split and get wedges of no thickness between their
  /// two sides, from the first label of a pair to the second (wedges()).
  std::string cohesive{};
  bool open_hinges = false;  ///< vertices at which parts hang are doubled, so that they come apart
  int threads = 0;           ///< 1 to 1,024, or 0 for all cores
  /// Bytes that the run may take; the mesh in memory, and the volume's arrays, come on top.  0
  /// stands for half of what the machine has to spare.
  std::uint64_t memory = 0;
  /// The folder for spilled blocks and for the checkpoint that resume goes on from; if empty, there
  /// is neither.  The run makes the folder and removes it after success.
  std::filesystem::path workdir{};
  /// Whether to go on from what a run that ended early left in workdir, or in keep.
  bool resume = false;
  /// A folder, used instead of workdir, in which the run keeps what later runs of the edited volume
  /// need not do again; if empty, nothing is kept.  It needs the setting order=colour.
  std::filesystem::path keep{};
  /// The most bytes that this folder takes when a run ends, until another run says otherwise; what
  /// was dropped is made again when needed.  0 keeps the limit of an earlier run, if any.
  std::uint64_t keep_bytes = 0;
  /// Whether an earlier run of the same settings has kept something there; only windows that the
  /// edit reaches are then meshed again.  The mesh is that of a run that begins afresh; the report
  /// tells what the edit did ("delta"), unless no run was complete there.
  bool from_kept = false;
  /// With from_kept, boxes of voxels, counted as by crop, that hold all changes since the
  /// last run that returned, and that alone are read, beside a sample that must not have changed;
  /// if empty, everything may have changed.  A run that threw may have kept its labels all the
  /// same, so its boxes must be there, too.
  std::vector<Box> changed{};
  /// Images whose values tets get, as `mwmesh mesh --sample` has them: "NAME=FILE" or
  /// "NAME=FILE:mode", several joined by ';'.  The voxels of a .npy file are those of the volume,
  /// none of which it may lack.
  std::string sample{};
  Certify certify = Certify::kAuto;
  bool report = true;  ///< if false, quality and shape are not measured, and reports are empty
  /// After drop_specks, voxels of these labels are filled where others hang together by an edge or
  /// a corner alone.
  std::vector<std::uint64_t> weld{};
  /// Labels before merge, as VolumeFile::object has them: the mesh has what these become, and no
  /// others.  Where labels or background is given, that counts instead.
  std::vector<std::uint64_t> object{};
  bool force = false;  ///< meshes a volume that looks like an image, too, which else is kUsage
};

struct Progress {
  std::uint64_t done = 0;   ///< windows that are finished
  std::uint64_t total = 0;  ///< windows of the run
  std::optional<double> seconds_left{};
};

/// Callbacks that watch a run; none of them changes the mesh.  Any thread may call them, but only
/// cancel is called by several threads at once.
struct Hooks {
  /// After each window; then, while the mesh is written, some more times with all windows done.
  std::function<void(const Progress& progress)> progress{};
  /// Is asked before each read of voxels, after each window, and about once a second while a server
  /// is silent; when it returns true, the run ends with kCancelled.  A window takes below a second
  /// as a rule, but can take half a minute where nearly all of its voxels differ from their
  /// neighbours (noise); smaller windows (Settings) take less.
  std::function<bool()> cancel{};
  /// Is told, before the first window, what may not be meant: a spacing that cuts voxels into many
  /// layers, or labels that were rounded.
  std::function<void(const std::string& line)> warn{};
};

/// A mesh in memory.
struct Mesh {
  std::vector<Vector> points{};                      ///< world coordinates
  std::vector<std::array<std::uint64_t, 4>> tets{};  ///< rows of points; positive orientation
  std::vector<std::uint64_t> labels{};               ///< by tet
  bool labels_are_signed = false;
  std::vector<LabelName> names{};  ///< of labels that are in the mesh
  /// For each name a number for each tet (Options::sample, or from a file); NaN if unknown.  Files
  /// have names of a letter and up to 30 letters, digits and '_', none of them "label" and no two
  /// alike except for capitals; others are written as such names ("Stress XX" as "Stress_XX").
  std::map<std::string, std::vector<double>> values{};
  /// JSON, the keys of `mwmesh mesh --report`; empty when there is none.  Its "settings" are those
  /// of Settings without preset, with threads, memory and workdir.
  std::string report{};
  std::string record{};  ///< one line of JSON about the run that made it, which files keep
  /// Whether each eight tets in turn are the straight parts of a curved tet, as from read_mesh().
  /// Written as "tet10-curved" such a mesh has these curved tets again.
  bool in_parts = false;
};

/// Takes a mesh that need not be in memory: begin, then points and tets by turns, then finish.
class MeshWriter {
 public:
  virtual ~MeshWriter() = default;
  virtual void begin(std::uint64_t tets) = 0;
  virtual void write_points(std::span<const Vector> points) = 0;
  /// REQUIRES: the points of these tets have been written.
  virtual void write_tets(std::span<const std::array<std::uint64_t, 4>> tets,
                          std::span<const std::uint64_t> labels) = 0;
  virtual void finish() = 0;
};

/// Meshes the volume.
/// ENSURES: the promises of the README: topology of every label, a conforming partition, quality
/// floor, distance bound; the same mesh for any number of threads, memory and workdir.
/// ERRORS: all kinds.  kCancelled, kResource and kInput may leave work in the workdir, as the
/// message says.
[[nodiscard]] Mesh mesh(const Volume& volume, const Settings& settings = {},
                        const Options& options = {}, const Hooks& hooks = {});

/// Meshes the volume into a writer, as mesh() does, but without wedges.  Returns the report.
/// ERRORS: also kUsage for Options::sample, as a writer takes no values of tets.
std::string mesh_to(MeshWriter& writer, const Volume& volume, const Settings& settings = {},
                    const Options& options = {}, const Hooks& hooks = {});

/// How a mesh is written into a file.
struct FileOptions {
  /// "tet4", "tet10" or "tet10-curved" (engine/MANUAL.md, "Curved tets").
  std::string element = "tet4";
  bool values = true;  ///< whether the values of tets are written
  /// Materials by equal ranges of a value, as `mwmesh mesh --materials` has them: "NAME=N" or
  /// "NAME=N:LO:HI"; empty for none.  A file that has a place for values has them, too.
  std::string materials{};
  bool deck = false;  ///< adds a job for CalculiX (.inp) or FEBio (.feb), as --deck static
  /// A file for the pairs of nodes of a mesh with the setting periodic, as --pairs, or empty.
  std::filesystem::path pairs{};
};

/// Meshes the volume into a file of any format that `mwmesh convert` writes, which appears under
/// its name only once the mesh is whole.  Returns the report.
/// ERRORS: also kUsage for what the format has no place for.
std::string mesh_to_file(const std::filesystem::path& path, const Volume& volume,
                         const Settings& settings, const Options& options, const Hooks& hooks,
                         const FileOptions& file);
/// Does the same; element is FileOptions::element.
std::string mesh_to_file(const std::filesystem::path& path, const Volume& volume,
                         const Settings& settings = {}, const Options& options = {},
                         const Hooks& hooks = {}, std::string_view element = "tet4");

/// Reads a mesh.  ERRORS: kInput naming file and place; kUsage for an unknown extension.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& path);
/// Writes a mesh into a file.  ERRORS: also kUsage for what the format has no place for.
void write_mesh(const Mesh& mesh, const std::filesystem::path& path, const FileOptions& file);
/// Does the same; element is FileOptions::element.
void write_mesh(const Mesh& mesh, const std::filesystem::path& path,
                std::string_view element = "tet4");
/// Returns the label of a mesh that has this number or name.  ERRORS: those of find_label(Volume).
[[nodiscard]] std::uint64_t find_label(const Mesh& mesh, std::string_view text);
/// Wedges of no thickness, by row.
struct Wedges {
  /// Rows of points: three of the facet under the wedge, whose normal points to the other side,
  /// then the three above them in the same order, which may be equal where an interface ends.
  std::vector<std::array<std::uint64_t, 6>> rows{};
  std::vector<std::array<std::uint64_t, 2>> labels{};  ///< under the wedge, and on top of it
};
/// Returns the wedges between the two sides of the interfaces that Options::cohesive named, by
/// interface.
[[nodiscard]] Wedges wedges(const Mesh& mesh);
/// Returns a PNG of all labels except the one around them, as `mwmesh picture` draws it.
/// ERRORS: kUsage for fewer than 16 or more than 8,192 pixels; kInput when nothing is to be seen.
[[nodiscard]] std::string picture(const Mesh& mesh, int width = 1200, int height = 900);
/// Returns "sha256:...", which is the same for every format, order of rows and machine.
[[nodiscard]] std::string digest(const Mesh& mesh);

struct Check {
  std::string name{};
  bool passed = false;
  std::string detail{};
};

struct Verdict {
  bool passed = false;
  std::vector<Check> checks{};
  /// JSON, the keys of `mwmesh verify --report` without version, settings and performance.
  std::string report{};
};

/// Checks a mesh against its volume, with the bounds that the mesh's record tells (1.5 voxels and a
/// radius ratio of 0.1 where it tells none).  Of the options only merge to background, weld,
/// threads and memory count.
[[nodiscard]] Verdict verify(const Mesh& mesh, const Volume& volume, const Options& options = {},
                             const Hooks& hooks = {});

}  // namespace mwmesh

#pragma GCC visibility pop
