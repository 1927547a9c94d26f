// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh_c.h for C++20, in this header alone: labelled voxels in, a tetrahedral mesh out.
//
//   std::vector<std::uint8_t> labels(64 * 64 * 64);  // x fastest
//   const auto volume = mwmesh::Volume::of(mwmesh::ArrayVolume{
//       .data = labels.data(), .type = mwmesh::VoxelType::kU8, .shape = {64, 64, 64}});
//   const mwmesh::Mesh mesh = mwmesh::mesh(volume, {{"max_distance", "1"}});
//   mesh.save("mesh.vtu");
//
// Each function does what the C function of its name does, whose comment has guarantees, units,
// threads and errors.  All throw Error, and std::bad_alloc where this header itself gets no memory;
// what callbacks throw ends the run and passes through.
// Objects that were moved from have nothing in them (kUsage).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "mwmesh_c.h"

namespace mwmesh {

/// See mw_status; what ends a run as kCallback is what the callback threw.
enum class ErrorKind {
  kInternal = 1,
  kUsage,
  kInput,
  kResource,
  kCheckFailed,
  kCancelled,
  kCallback
};
static_assert(static_cast<int>(ErrorKind::kCallback) == MW_CALLBACK);

/// What this library throws.  The message names the thing, the reason and the way out.
class __attribute__((visibility("default"))) Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message, std::string option = {})
      : std::runtime_error(message), kind_(kind), option_(std::move(option)) {}
  [[nodiscard]] ErrorKind kind() const { return kind_; }
  /// The name of the option that it is about, "max_distance", or empty.
  [[nodiscard]] const std::string& option() const { return option_; }

 private:
  ErrorKind kind_;
  std::string option_;
};

using Vector = std::array<double, 3>;
using Index = std::array<std::int64_t, 3>;
using Tet = std::array<std::uint64_t, 4>;  ///< rows of points

/// Voxels from lo to hi, hi not included.
struct Box {
  Index lo{};
  Index hi{};
};

enum class VoxelType { kU8, kU16, kU32, kU64, kI8, kI16, kI32, kI64, kF32, kF64 };
static_assert(static_cast<int>(VoxelType::kF64) == MW_F64);

/// See mw_space.
struct Space {
  Vector spacing{1, 1, 1};
  Vector origin{0, 0, 0};
  std::array<Vector, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::string unit{};
  std::string frame = "own";
};

struct LabelName {
  std::uint64_t label = 0;
  std::string name{};  ///< may be empty
  /// Red, green, blue and opacity; empty if unknown.
  std::optional<std::array<std::uint8_t, 4>> colour{};
};

/// Voxels in memory, which must stay there as long as the Volume and its copies live.
struct ArrayVolume {
  const void* data = nullptr;  ///< address of voxel (0, 0, 0)
  VoxelType type = VoxelType::kU8;
  Index shape{};
  Index strides{};  ///< in bytes, of any sign; all 0 means x fastest, without gaps
  Space space{};
};

/// Voxels that are fetched box by box, by many threads at once; see mw_volume_of_reader().
struct RegionVolume {
  VoxelType type = VoxelType::kU8;
  Index shape{};
  Index chunk{};  ///< boxes that begin and end at its multiples are cheapest; 0 if all are alike
  Space space{};
  std::function<void(const Box& box, std::span<std::uint64_t> out)> read{};  ///< x fastest
};

struct Progress {
  std::uint64_t done = 0;   ///< windows that are finished
  std::uint64_t total = 0;  ///< windows of the run
  std::optional<double> seconds_left{};
};

/// What watches a run; see mw_hooks.
struct Hooks {
  std::function<void(const Progress& progress)> progress{};
  std::function<bool()> cancel{};
  std::function<void(const std::string& line)> warn{};
};

class Volume;

namespace detail {

struct Free {
  void operator()(mw_error* error) const { mw_error_free(error); }
  void operator()(mw_options* options) const { mw_options_free(options); }
  void operator()(mw_volume* volume) const { mw_volume_free(volume); }
  void operator()(mw_mesh* mesh) const { mw_mesh_free(mesh); }
  void operator()(char* text) const { mw_free(text); }
};
template <class T>
using Owned = std::unique_ptr<T, Free>;

/// Returns what the C function returns, which is owned if it is a handle or a text to free.
template <class Function, class... Arguments>
auto call(const Function& function, Arguments... arguments) {
  mw_error* raw = nullptr;
  auto result = function(arguments..., &raw);
  if (const Owned<mw_error> error(raw); error) {
    throw Error(static_cast<ErrorKind>(mw_error_kind(raw)), mw_error_text(raw),
                mw_error_option(raw));
  }
  using Result = decltype(result);
  if constexpr (std::is_pointer_v<Result> && !std::is_const_v<std::remove_pointer_t<Result>>) {
    return Owned<std::remove_pointer_t<Result>>(result);
  } else {
    return result;
  }
}

template <class T>
T* held(T* handle) {
  if (handle == nullptr) throw Error(ErrorKind::kUsage, "this object was moved from");
  return handle;
}

/// Returns the text, or path, as C takes it.
inline const char* c_text(const std::string& text) {
  if (text.find('\0') == text.npos) return text.c_str();
  throw Error(ErrorKind::kUsage, text.c_str() + std::string(": has a zero byte in it"));
}

inline mw_space c_space(const Space& space) {
  mw_space out{};
  std::ranges::copy(space.spacing, out.spacing);
  std::ranges::copy(space.origin, out.origin);
  for (std::size_t i = 0; i < 3; ++i) std::ranges::copy(space.axes[i], out.axes[i]);
  out.unit = c_text(space.unit);
  out.frame = c_text(space.frame);
  return out;
}

inline Space space_of(const mw_space& in) {
  Space out{.spacing = std::to_array(in.spacing), .origin = std::to_array(in.origin)};
  for (std::size_t i = 0; i < 3; ++i) out.axes[i] = std::to_array(in.axes[i]);
  out.unit = in.unit;
  out.frame = in.frame;
  return out;
}

/// Returns the names that function(handle) has.
template <class Function, class Handle>
std::vector<LabelName> names(const Function& function, const Handle* handle) {
  const mw_name* rows = nullptr;
  std::vector<LabelName> out(function(handle, &rows));
  for (LabelName& name : out) {
    name = {.label = rows->label, .name = rows->name == nullptr ? "" : rows->name};
    if (rows->has_colour != 0) name.colour = std::to_array(rows->colour);
    ++rows;
  }
  return out;
}

template <class Function, class Handle>
std::uint64_t label(const Function& function, const Handle* handle, const std::string& text) {
  std::uint64_t out = 0;
  call(function, handle, c_text(text), &out);
  return out;
}

/// Returns the number of voxels of a box; it may wrap around where C refuses the box.
inline std::uint64_t voxels(const Index& lo, const Index& hi) {
  const auto edge = [&](std::size_t i) {
    return static_cast<std::uint64_t>(hi[i]) - static_cast<std::uint64_t>(lo[i]);
  };
  return edge(0) * edge(1) * edge(2);
}

/// What callbacks threw last, which must not cross C.
class Thrown {
 public:
  /// Calls work(); returns whether it threw nothing.
  template <class Work>
  bool keep(const Work& work) noexcept {
    try {
      work();
      return true;
    } catch (...) {
      const std::lock_guard lock(mutex_);
      last_ = std::current_exception();
      return false;
    }
  }
  void rethrow() {
    const std::lock_guard lock(mutex_);
    if (last_) std::rethrow_exception(last_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr last_;
};

/// The hooks of a run, whose functions C calls.
struct Watch {
  const Hooks& hooks;
  Thrown thrown{};

  static void progress(void* data, std::uint64_t done, std::uint64_t total, double left) {
    Watch& self = *static_cast<Watch*>(data);
    Progress at{.done = done, .total = total};
    if (left == left) at.seconds_left = left;
    self.thrown.keep([&] { self.hooks.progress(at); });
  }
  static int cancel(void* data) {
    Watch& self = *static_cast<Watch*>(data);
    bool ends = true;
    self.thrown.keep([&] {
      self.thrown.rethrow();
      ends = self.hooks.cancel && self.hooks.cancel();
    });
    return ends ? 1 : 0;
  }
  static void warn(void* data, const char* line) {
    Watch& self = *static_cast<Watch*>(data);
    self.thrown.keep([&] { self.hooks.warn(line); });
  }
};

/// Returns work(hooks); what hooks, or the reader of a volume, threw passes through.
template <class Work>
auto run(const Hooks& hooks, Thrown* reader, const Work& work) {
  Watch watch{hooks};
  const mw_hooks in_c{.size = sizeof(mw_hooks),
                      .data = &watch,
                      .progress = hooks.progress ? Watch::progress : nullptr,
                      .cancel = Watch::cancel,
                      .warn = hooks.warn ? Watch::warn : nullptr,
                      .stop = nullptr};
  try {
    auto result = work(&in_c);
    watch.thrown.rethrow();
    return result;
  } catch (const Error& error) {
    watch.thrown.rethrow();
    if (reader != nullptr && error.kind() == ErrorKind::kCallback) reader->rethrow();
    throw;
  }
}

/// A region as C reads it.
struct Reader {
  std::function<void(const Box&, std::span<std::uint64_t>)> read{};
  Thrown thrown{};

  static int fetch(void* data, const std::int64_t lo[3], const std::int64_t hi[3],
                   std::uint64_t* labels) {
    auto& self = *static_cast<Reader*>(data);
    const Box box{{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}};
    const std::span out(labels, voxels(box.lo, box.hi));
    return self.thrown.keep([&] { self.read(box, out); }) ? 0 : 1;
  }
};

}  // namespace detail

inline const char* version() {
  return mw_version();
}

/// Values of options by name, as text in the form of the command line; see mw_options.
class Options {
 public:
  Options() : handle_(detail::call(mw_options_new)) {}
  Options(std::initializer_list<std::pair<std::string, std::string>> values) : Options() {
    for (const auto& [name, text] : values) set(name, text);
  }
  /// ERRORS: kUsage naming the option, what it may be, or the names that there are.
  Options& set(const std::string& name, const std::string& text) {
    detail::call(mw_options_set, handle(), detail::c_text(name), detail::c_text(text));
    return *this;
  }
  /// Returns the effective value.  ERRORS: kUsage for a name that does not exist.
  [[nodiscard]] std::string get(const std::string& name) const {
    return detail::call(mw_options_get, handle(), detail::c_text(name));
  }
  /// Returns all options as JSON.
  [[nodiscard]] static std::string table() {
    if (const char* text = mw_options_table()) return text;
    throw Error(ErrorKind::kResource, "memory is out");
  }
  [[nodiscard]] mw_options* handle() const { return detail::held(handle_.get()); }

 private:
  detail::Owned<mw_options> handle_;
};

/// A labelled volume, which is cheap to copy.
class Volume {
 public:
  /// ERRORS: kUsage for an empty or too large shape, or a type or space that makes no sense.
  [[nodiscard]] static Volume of(const ArrayVolume& array) {
    const mw_space space = detail::c_space(array.space);
    return {nullptr,
            detail::call(mw_volume_of_array, array.data, static_cast<mw_type>(array.type),
                         array.shape.data(),
                         array.strides == Index{} ? nullptr : array.strides.data(), &space)};
  }
  [[nodiscard]] static Volume of(const RegionVolume& region) {
    const mw_space space = detail::c_space(region.space);
    auto reader = std::make_shared<detail::Reader>();
    reader->read = region.read;
    const auto fetch = region.read ? &detail::Reader::fetch : nullptr;
    return {reader, detail::call(mw_volume_of_reader, static_cast<mw_type>(region.type),
                                 region.shape.data(), region.chunk.data(), &space, fetch,
                                 static_cast<void*>(reader.get()))};
  }
  /// ERRORS: kInput naming file, field, reason and way out; kUsage for options that do not fit it.
  [[nodiscard]] static Volume open(const std::filesystem::path& path, const Options& options = {},
                                   const Hooks& hooks = {}) {
    return detail::run(hooks, nullptr, [&](const mw_hooks* watch) {
      return Volume(nullptr,
                    detail::call(mw_volume_open, detail::c_text(path), options.handle(), watch));
    });
  }
  /// Returns this volume with these names added; where both name a label, these win.
  [[nodiscard]] Volume with_names(const std::vector<LabelName>& names) const {
    std::vector<mw_name> rows;
    for (const LabelName& name : names) {
      rows.push_back({name.label, detail::c_text(name.name), {}, name.colour ? 1 : 0});
      if (name.colour) std::ranges::copy(*name.colour, rows.back().colour);
    }
    return {reader_, detail::call(mw_volume_with_names, handle(), rows.data(), rows.size())};
  }

  /// Returns work(hooks), which reads the volume through its handle().
  template <class Work>
  auto run(const Hooks& hooks, const Work& work) const {
    return detail::run(hooks, reader_ ? &reader_->thrown : nullptr, work);
  }
  [[nodiscard]] const mw_volume* handle() const { return detail::held(handle_.get()); }

  [[nodiscard]] Index shape() const {
    Index out{};
    mw_volume_shape(handle(), out.data());
    return out;
  }
  [[nodiscard]] VoxelType type() const { return static_cast<VoxelType>(mw_volume_type(handle())); }
  [[nodiscard]] Space space() const {
    mw_space out{};
    mw_volume_space(handle(), &out);
    return detail::space_of(out);
  }
  [[nodiscard]] bool labels_are_signed() const { return mw_volume_is_signed(handle()) != 0; }
  [[nodiscard]] std::vector<LabelName> names() const {
    return detail::names(mw_volume_names, handle());
  }
  /// ERRORS: kUsage unless the box is in the volume and out.size() the number of its voxels.
  void read(const Box& box, std::span<std::uint64_t> out) const {
    if (detail::voxels(box.lo, box.hi) != out.size()) {
      throw Error(ErrorKind::kUsage, "there must be room for each voxel of the box, and no more");
    }
    run({}, [&](const mw_hooks*) {
      return detail::call(mw_volume_read, handle(), box.lo.data(), box.hi.data(), out.data());
    });
  }
  /// Returns the label with this number or name: "7", "-1", "Liver".  ERRORS: kUsage.
  [[nodiscard]] std::uint64_t find_label(const std::string& text) const {
    return detail::label(mw_volume_find_label, handle(), text);
  }

 private:
  Volume(std::shared_ptr<detail::Reader> reader, detail::Owned<mw_volume> handle)
      : reader_(std::move(reader)), handle_(std::move(handle)) {}

  std::shared_ptr<detail::Reader> reader_;  // lives as long as the handle
  std::shared_ptr<mw_volume> handle_;
};

/// Wedges of no thickness between the two sides of interfaces; see mw_mesh_column().
struct Wedges {
  std::span<const std::array<std::uint64_t, 6>> rows{};
  std::span<const std::array<std::uint64_t, 2>> labels{};
};

/// A mesh in memory.  Spans live as long as it, those of values until others are set.
class Mesh {
 public:
  /// Takes over what a C function returned.
  explicit Mesh(detail::Owned<mw_mesh> handle) : handle_(std::move(handle)) {}
  /// ERRORS: kUsage for a tet that names a point which is not there, and unless each has a label.
  Mesh(std::span<const Vector> points, std::span<const Tet> tets,
       std::span<const std::uint64_t> labels, bool labels_are_signed = false) {
    if (labels.size() != tets.size()) {
      throw Error(ErrorKind::kUsage, "mesh: there must be one label a tet");
    }
    handle_ = detail::call(mw_mesh_of_arrays, reinterpret_cast<const double*>(points.data()),
                           points.size(), reinterpret_cast<const std::uint64_t*>(tets.data()),
                           labels.data(), tets.size(), labels_are_signed ? 1 : 0);
  }

  [[nodiscard]] std::span<const Vector> points() const { return rows<Vector>("points"); }
  [[nodiscard]] std::span<const Tet> tets() const { return rows<Tet>("tets"); }
  [[nodiscard]] std::span<const std::uint64_t> labels() const {
    return rows<std::uint64_t>("labels");
  }
  [[nodiscard]] bool labels_are_signed() const { return column("labels").type == MW_I64; }
  [[nodiscard]] Wedges wedges() const {
    return {rows<std::array<std::uint64_t, 6>>("wedges"),
            rows<std::array<std::uint64_t, 2>>("wedge_labels")};
  }
  /// Returns the columns of values by name: a number for each tet, NaN if unknown.
  [[nodiscard]] std::map<std::string, std::span<const double>> values() const {
    std::map<std::string, std::span<const double>> out;
    for (std::size_t i = 0; i < mw_mesh_value_count(handle()); ++i) {
      mw_column column{};
      const std::string name = mw_mesh_values(handle(), i, &column);
      out[name] = {static_cast<const double*>(column.data), column.rows};
    }
    return out;
  }
  void set_values(const std::string& name, std::span<const double> numbers) {
    detail::call(mw_mesh_set_values, handle(), detail::c_text(name), numbers.data(),
                 numbers.size());
  }
  [[nodiscard]] std::vector<LabelName> names() const {
    return detail::names(mw_mesh_names, handle());
  }
  [[nodiscard]] std::string report() const { return mw_mesh_text(handle(), "report"); }
  [[nodiscard]] std::string record() const { return mw_mesh_text(handle(), "record"); }
  [[nodiscard]] bool is_in_parts() const { return mw_mesh_is_in_parts(handle()) != 0; }
  /// ERRORS: those of Volume::find_label().
  [[nodiscard]] std::uint64_t find_label(const std::string& text) const {
    return detail::label(mw_mesh_find_label, handle(), text);
  }
  /// ERRORS: kUsage for what the format has no place for.
  void save(const std::filesystem::path& path, const Options& options = {}) const {
    detail::call(mw_mesh_write, handle(), detail::c_text(path), options.handle());
  }
  /// Returns what `mwmesh mesh` prints last; of a mesh without a report what can be measured on it.
  [[nodiscard]] std::string summary() const {
    return detail::call(mw_mesh_summary, handle(), mw_mesh_text(handle(), "report")).get();
  }
  [[nodiscard]] std::string digest() const { return detail::call(mw_mesh_digest, handle()).get(); }
  /// Returns a PNG.  ERRORS: kUsage; kInput when nothing is to be seen.
  [[nodiscard]] std::string picture(int width = 1200, int height = 900) const {
    std::size_t bytes = 0;
    const auto png = detail::call(mw_mesh_picture, handle(), width, height, &bytes);
    return {png.get(), bytes};
  }
  [[nodiscard]] mw_mesh* handle() const { return detail::held(handle_.get()); }

 private:
  [[nodiscard]] mw_column column(const char* name) const {
    mw_column out{};
    detail::call(mw_mesh_column, handle(), name, &out);
    return out;
  }
  template <class Row>
  [[nodiscard]] std::span<const Row> rows(const char* name) const {
    const mw_column found = column(name);
    return {static_cast<const Row*>(found.data), found.rows};
  }

  detail::Owned<mw_mesh> handle_;
};

struct Verdict {
  bool passed = false;
  std::string report{};  ///< JSON
};

[[nodiscard]] inline Mesh mesh(const Volume& volume, const Options& options = {},
                               const Hooks& hooks = {}) {
  return volume.run(hooks, [&](const mw_hooks* watch) {
    return Mesh(detail::call(mw_make_mesh, volume.handle(), options.handle(), watch));
  });
}

/// Returns the report.  ERRORS: also kUsage for what the format has no place for.
inline std::string mesh_to_file(const std::filesystem::path& path, const Volume& volume,
                                const Options& options = {}, const Hooks& hooks = {}) {
  return volume.run(hooks, [&](const mw_hooks* watch) {
    char* report = nullptr;
    detail::call(mw_mesh_to_file, detail::c_text(path), volume.handle(), options.handle(), watch,
                 &report);
    const detail::Owned<char> owned(report);
    return std::string(report == nullptr ? "" : report);
  });
}

/// ERRORS: kInput naming file and place; kUsage for an unknown extension.
[[nodiscard]] inline Mesh read_mesh(const std::filesystem::path& path) {
  return Mesh(detail::call(mw_mesh_read, detail::c_text(path)));
}

[[nodiscard]] inline Verdict verify(const Mesh& mesh, const Volume& volume,
                                    const Options& options = {}, const Hooks& hooks = {}) {
  return volume.run(hooks, [&](const mw_hooks* watch) {
    int passed = 0;
    const auto report =
        detail::call(mw_verify, mesh.handle(), volume.handle(), options.handle(), watch, &passed);
    return Verdict{.passed = passed != 0, .report = report.get()};
  });
}

/// Returns a random volume, x fastest.  ERRORS: kUsage.
[[nodiscard]] inline std::vector<std::uint64_t> synth(const std::string& kind, const Index& shape,
                                                      std::uint64_t labels, std::uint64_t seed) {
  std::vector<std::uint64_t> voxels;
  const std::uint64_t count = detail::voxels({}, shape);
  if (count > voxels.max_size()) throw std::bad_alloc();
  voxels.resize(count);
  detail::call(mw_synth, detail::c_text(kind), shape.data(), labels, seed, voxels.data());
  return voxels;
}

/// ERRORS: kInput for numbers that make no place; kUsage for another frame.
[[nodiscard]] inline Space space_of_affine(const std::array<std::array<double, 4>, 3>& affine,
                                           const std::string& frame = "own",
                                           const std::optional<Vector>& spacing = {}) {
  mw_space out{};
  detail::call(mw_space_of_affine, reinterpret_cast<const double(*)[4]>(affine.data()),
               detail::c_text(frame), spacing ? spacing->data() : nullptr, &out);
  return detail::space_of(out);
}

}  // namespace mwmesh
