// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The C++ library for Python: arrays in and out without copies.  Python's side is mwmesh/*.py.
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstring>
#include <iterator>
#include <utility>

#include "engine/mwmesh.h"
#include "engine/python/watched_run.h"

namespace py = pybind11;

namespace mwmesh::python {
namespace {

/// Returns an object that any thread may let go of.
std::shared_ptr<py::object> shared(py::object object) {
  return {new py::object(std::move(object)), [](py::object* o) {
            const py::gil_scoped_acquire gil;
            delete o;
          }};
}

/// The types of numpy's arrays, in the order of VoxelType.
constexpr const char* kTypeCodes[] = {"u1", "u2", "u4", "u8", "i1", "i2", "i4", "i8", "f4", "f8"};
static_assert(std::size(kTypeCodes) == static_cast<std::size_t>(VoxelType::kF64) + 1);

VoxelType voxel_type(const py::dtype& type) {
  const std::string code = std::string(1, type.kind()) + std::to_string(type.itemsize());
  if (code == "b1") return VoxelType::kU8;
  for (std::size_t i = 0; i < std::size(kTypeCodes); ++i) {
    if (code == kTypeCodes[i]) return static_cast<VoxelType>(i);
  }
  throw Error(ErrorKind::kUsage, "array: labels of type " + py::repr(type).cast<std::string>() +
                                     ": expected integers, or floats of 32 or 64 bits that are "
                                     "whole numbers; convert others, as with astype(\"float32\")");
}

/// A volume, and the array that it reads, indexed [x, y, z], which lives as long as the volume.
struct HeldVolume {
  Volume volume;
  std::shared_ptr<py::object> array;  ///< none for files
};

HeldVolume volume_of_array(const py::array& array, const Space& space,
                           const std::vector<LabelName>& names) {
  ArrayVolume told{
      .data = array.data(), .type = voxel_type(array.dtype()), .space = space, .names = names};
  for (std::size_t i = 0; i < 3; ++i) {
    told.shape[i] = array.shape(static_cast<py::ssize_t>(i));
    told.strides[i] = array.strides(static_cast<py::ssize_t>(i));
    if (told.strides[i] != 0) continue;
    if (told.shape[i] > 1) throw Error(ErrorKind::kUsage, "array: repeats itself along an axis");
    told.strides[i] = array.itemsize();  // no step is ever taken along an axis of one voxel
  }
  return {Volume::of(told), shared(array)};
}

/// Makes a volume of fetch(x0, y0, z0, x1, y1, z1), which returns 64-bit labels [z, y, x], without
/// gaps.
HeldVolume volume_of_region(const py::object& fetch, const py::dtype& type, const Index& shape,
                            const Index& chunk, const Space& space,
                            const std::vector<LabelName>& names) {
  const auto held = shared(fetch);
  RegionVolume told{
      .type = voxel_type(type), .shape = shape, .chunk = chunk, .space = space, .names = names};
  told.read = [held](const Box& box, std::span<std::uint64_t> out) {
    const py::gil_scoped_acquire gil;
    const py::object made =
        (*held)(box.lo[0], box.lo[1], box.lo[2], box.hi[0], box.hi[1], box.hi[2]);
    const auto labels = py::cast<py::array>(made);
    const auto has_extent = [&](py::ssize_t axis, std::size_t k) {
      return labels.shape(axis) == box.hi[k] - box.lo[k];
    };
    const bool has_shape =
        labels.ndim() == 3 && has_extent(0, 2) && has_extent(1, 1) && has_extent(2, 0);
    if (!has_shape || labels.itemsize() != 8) {
      throw Error(ErrorKind::kInput, "volume: a region came back with another shape");
    }
    std::memcpy(out.data(), labels.data(), out.size_bytes());
  };
  return {Volume::of(told), held};
}

/// Returns a read-only view of one of the lists of a mesh, which lives as long as the view.
template <class T>
py::array_t<T> view(const py::object& owner, const void* data, std::vector<py::ssize_t> shape) {
  py::array_t<T> array(std::move(shape), static_cast<const T*>(data), owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

template <class T>
py::array_t<T> column(const py::object& owner, const Mesh& mesh) {
  return view<T>(owner, mesh.labels.data(), {static_cast<py::ssize_t>(mesh.labels.size())});
}

/// Returns {name: view of its numbers by tet}.
py::dict values_of(const py::object& self) {
  py::dict out;
  for (const auto& [name, numbers] : self.cast<const Mesh&>().values) {
    out[py::str(name)] =
        view<double>(self, numbers.data(), {static_cast<py::ssize_t>(numbers.size())});
  }
  return out;
}

using Points = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Rows = py::array_t<std::uint64_t, py::array::c_style | py::array::forcecast>;

void set_values(Mesh& mesh, const std::string& name, const Points& numbers) {
  if (numbers.ndim() != 1 || static_cast<std::size_t>(numbers.size()) != mesh.tets.size()) {
    throw Error(ErrorKind::kUsage, "values: there must be one number a tet");
  }
  mesh.values[name].assign(numbers.data(), numbers.data() + numbers.size());
}

void require_columns(const py::array& array, py::ssize_t columns, const char* what) {
  if (array.ndim() == 2 && array.shape(1) == columns) return;
  throw Error(ErrorKind::kUsage,
              std::string(what) + ": expected " + std::to_string(columns) + " columns");
}

Mesh mesh_of_arrays(const Points& points, const Rows& tets, const Rows& labels, bool is_signed) {
  require_columns(points, 3, "points");
  require_columns(tets, 4, "tets");
  if (labels.ndim() != 1 || labels.size() != tets.shape(0)) {
    throw Error(ErrorKind::kUsage, "labels: there must be one label a tet");
  }
  Mesh mesh;
  mesh.points.resize(static_cast<std::size_t>(points.shape(0)));
  std::memcpy(mesh.points.data(), points.data(), mesh.points.size() * sizeof(Vector));
  mesh.tets.resize(static_cast<std::size_t>(tets.shape(0)));
  std::memcpy(mesh.tets.data(), tets.data(), mesh.tets.size() * 4 * sizeof(std::uint64_t));
  mesh.labels.assign(labels.data(), labels.data() + labels.size());
  mesh.labels_are_signed = is_signed;
  return mesh;
}

void add_space(py::module_& module) {
  py::class_<Space>(module, "Space")
      .def(py::init<>())
      .def_readwrite("spacing", &Space::spacing)
      .def_readwrite("origin", &Space::origin)
      .def_readwrite("axes", &Space::axes)
      .def_readwrite("unit", &Space::unit)
      .def_readwrite("frame", &Space::frame);
  module.def("space_of_affine", &space_of_affine, py::arg("affine"), py::arg("frame"),
             py::arg("spacing"));
  py::class_<LabelName>(module, "LabelName")
      .def(py::init([](std::uint64_t label, std::string name,
                       std::optional<std::array<std::uint8_t, 4>> colour) {
        return LabelName{.label = label, .name = std::move(name), .colour = colour};
      }))
      .def_readonly("label", &LabelName::label)
      .def_readonly("name", &LabelName::name)
      .def_readonly("colour", &LabelName::colour);
  module.def("read_names", [](const std::string& path) { return read_names(path); });
}

/// Returns all labels of a volume, indexed [z, y, x].
py::array labels_of(const HeldVolume& held) {
  const Index shape = held.volume.shape();
  py::array_t<std::uint64_t> out({shape[2], shape[1], shape[0]});
  const std::span<std::uint64_t> labels(out.mutable_data(), static_cast<std::size_t>(out.size()));
  {
    const WithoutLock no_gil;
    held.volume.read({{0, 0, 0}, shape}, labels);
  }
  return held.volume.labels_are_signed() ? out.attr("view")("i8").cast<py::array>() : out;
}

void add_volume(py::module_& module) {
  py::class_<HeldVolume>(module, "Volume")
      .def_property_readonly("shape", [](const HeldVolume& v) { return v.volume.shape(); })
      .def_property_readonly("space", [](const HeldVolume& v) { return v.volume.space(); })
      .def_property_readonly("labels_are_signed",
                             [](const HeldVolume& v) { return v.volume.labels_are_signed(); })
      .def_property_readonly("names", [](const HeldVolume& v) { return v.volume.names(); })
      .def_property_readonly(
          "dtype",
          [](const HeldVolume& v) { return kTypeCodes[static_cast<int>(v.volume.type())]; })
      .def("labels", &labels_of)
      .def("with_names", [](const HeldVolume& v, const std::vector<LabelName>& names) {
        return HeldVolume{v.volume.with_names(names), v.array};
      });
  module.def("find_label", [](const HeldVolume& v, const std::string& text) {
    return find_label(v.volume, text);
  });
  module.def("with_label_numbers", [](const HeldVolume& v, const std::string& text) {
    return with_label_numbers(v.volume, text);
  });
  module.def("volume_of_array", &volume_of_array);
  module.def("volume_of_region", &volume_of_region);
  module.def(
      "open_volume",
      [](const std::string& path, const std::string& dataset, std::optional<int> scale,
         std::optional<Vector> spacing, std::optional<Vector> origin, const std::string& frame,
         std::optional<std::pair<Index, Index>> crop, const std::string& overlap,
         const std::string& values, const std::vector<std::uint64_t>& object, bool trust_paths,
         const std::string& cache, const std::string& use_form) {
        VolumeFile file{.path = path,
                        .dataset = dataset,
                        .scale = scale,
                        .spacing = spacing,
                        .origin = origin,
                        .frame = frame,
                        .overlap = overlap,
                        .trust_paths = trust_paths,
                        .values = values,
                        .object = object,
                        .cache = cache,
                        .use_form = use_form};
        if (crop) file.crop = Box{crop->first, crop->second};
        return watched_run(py::none(), [&](const Hooks& hooks) {
          return HeldVolume{Volume::open(file, hooks), nullptr};
        });
      });
}

void add_options(py::module_& module) {
  py::enum_<Certify>(module, "Certify")
      .value("auto", Certify::kAuto)
      .value("on", Certify::kOn)
      .value("off", Certify::kOff);
  py::class_<Options>(module, "Options")
      .def(py::init<>())
      .def_readwrite("merge", &Options::merge)
      .def_readwrite("drop_specks", &Options::drop_specks)
      .def_readwrite("weld", &Options::weld)
      .def_readwrite("object", &Options::object)
      .def_readwrite("specks_joined_by_corners", &Options::specks_joined_by_corners)
      .def_readwrite("labels", &Options::labels)
      .def_readwrite("background", &Options::background)
      .def_readwrite("parts", &Options::parts)
      .def_readwrite("split", &Options::split)
      .def_readwrite("cohesive", &Options::cohesive)
      .def_readwrite("open_hinges", &Options::open_hinges)
      .def_readwrite("force", &Options::force)
      .def_readwrite("threads", &Options::threads)
      .def_readwrite("memory", &Options::memory)
      .def_property("workdir", nullptr,
                    [](Options& o, const std::string& path) { o.workdir = path; })
      .def_readwrite("resume", &Options::resume)
      .def_property("keep", nullptr, [](Options& o, const std::string& path) { o.keep = path; })
      .def_readwrite("keep_bytes", &Options::keep_bytes)
      .def_readwrite("from_kept", &Options::from_kept)
      .def_property("changed", nullptr,
                    [](Options& o, const std::vector<std::pair<Index, Index>>& boxes) {
                      o.changed.clear();
                      for (const auto& [lo, hi] : boxes) o.changed.push_back({lo, hi});
                    })
      .def_readwrite("sample", &Options::sample)
      .def_readwrite("certify", &Options::certify)
      .def_readwrite("report", &Options::report);
  py::class_<FileOptions>(module, "FileOptions")
      .def(py::init([](std::string element, bool values, std::string materials, bool deck,
                       const std::string& pairs) {
        return FileOptions{.element = std::move(element),
                           .values = values,
                           .materials = std::move(materials),
                           .deck = deck,
                           .pairs = pairs};
      }));
  module.def("bytes_of_text", &bytes_of_text);
}

Settings settings_of(const std::map<std::string, std::string>& values) {
  Settings settings;
  for (const auto& [name, text] : values) settings.set(name, text);
  return settings;
}

using Values = std::map<std::string, std::string>;

void add_runs(py::module_& module) {
  module.def("mesh", [](const HeldVolume& volume, const Values& settings, const Options& options,
                        const py::object& progress) {
    return watched_run(progress, [&, chosen = settings_of(settings)](const Hooks& hooks) {
      return mwmesh::mesh(volume.volume, chosen, options, hooks);
    });
  });
  module.def("mesh_to_file", [](const std::string& path, const HeldVolume& volume,
                                const Values& settings, const Options& options,
                                const py::object& progress, const FileOptions& file) {
    return watched_run(progress, [&, chosen = settings_of(settings)](const Hooks& hooks) {
      return mwmesh::mesh_to_file(path, volume.volume, chosen, options, hooks, file);
    });
  });
  module.def("verify", [](const Mesh& mesh, const HeldVolume& volume, const Options& options) {
    return watched_run(py::none(), [&](const Hooks& hooks) {
      return mwmesh::verify(mesh, volume.volume, options, hooks);
    });
  });
  module.def("settings", [] {
    py::list out;
    for (const SettingInfo& s : Settings::all()) {
      out.append(py::make_tuple(s.name, s.help, s.fallback, s.choices));
    }
    return out;
  });
}

void add_mesh(py::module_& module) {
  py::class_<Mesh>(module, "Mesh")
      .def(py::init(&mesh_of_arrays))
      .def_property_readonly("points",
                             [](const py::object& self) {
                               const Mesh& mesh = self.cast<const Mesh&>();
                               const auto rows = static_cast<py::ssize_t>(mesh.points.size());
                               return view<double>(self, mesh.points.data(), {rows, 3});
                             })
      .def_property_readonly("tets",
                             [](const py::object& self) {
                               const Mesh& mesh = self.cast<const Mesh&>();
                               const auto rows = static_cast<py::ssize_t>(mesh.tets.size());
                               return view<std::int64_t>(self, mesh.tets.data(), {rows, 4});
                             })
      .def_property_readonly("labels",
                             [](const py::object& self) -> py::array {
                               const Mesh& mesh = self.cast<const Mesh&>();
                               if (mesh.labels_are_signed) return column<std::int64_t>(self, mesh);
                               return column<std::uint64_t>(self, mesh);
                             })
      .def_readonly("labels_are_signed", &Mesh::labels_are_signed)
      .def_property_readonly("values", &values_of)
      .def("set_values", &set_values)
      .def_readwrite("names", &Mesh::names)
      .def_readonly("report", &Mesh::report)
      .def_readwrite("record", &Mesh::record)
      .def_readwrite("in_parts", &Mesh::in_parts)
      .def("digest", [](const Mesh& mesh) {
        const WithoutLock no_gil;
        return digest(mesh);
      });
  module.def("find_label",
             [](const Mesh& mesh, const std::string& text) { return find_label(mesh, text); });
  module.def("wedges", [](const Mesh& mesh) {
    const Wedges found = [&] {
      const WithoutLock no_gil;
      return wedges(mesh);
    }();
    const auto count = static_cast<py::ssize_t>(found.rows.size());
    py::array_t<std::int64_t> rows({count, py::ssize_t{6}});
    py::array_t<std::uint64_t> labels({count, py::ssize_t{2}});
    std::memcpy(rows.mutable_data(), found.rows.data(), found.rows.size() * sizeof found.rows[0]);
    std::memcpy(labels.mutable_data(), found.labels.data(),
                found.labels.size() * sizeof found.labels[0]);
    return py::make_tuple(rows, labels);
  });
  module.def("picture", [](const Mesh& mesh, int width, int height) {
    return py::bytes([&] {
      const WithoutLock no_gil;
      return picture(mesh, width, height);
    }());
  });
  module.def("read_mesh", [](const std::string& path) {
    const WithoutLock no_gil;
    return read_mesh(path);
  });
  module.def("write_mesh", [](const Mesh& mesh, const std::string& path, const FileOptions& file) {
    const WithoutLock no_gil;
    write_mesh(mesh, path, file);
  });
}

void add_verdict(py::module_& module) {
  py::class_<Verdict>(module, "Verdict")
      .def_readonly("passed", &Verdict::passed)
      .def_readonly("report", &Verdict::report)
      .def_property_readonly("checks", [](const Verdict& verdict) {
        py::list out;
        for (const Check& c : verdict.checks)
          out.append(py::make_tuple(c.name, c.passed, c.detail));
        return out;
      });
}

py::array_t<std::uint64_t> synth_array(const std::string& kind, const Index& shape,
                                       std::uint64_t labels, std::uint64_t seed) {
  auto made = std::make_unique<std::vector<std::uint64_t>>(synth(kind, shape, labels, seed));
  std::vector<std::uint64_t>& list = *made;
  const py::capsule owner(made.release(),
                          [](void* p) { delete static_cast<std::vector<std::uint64_t>*>(p); });
  return py::array_t<std::uint64_t>({shape[2], shape[1], shape[0]}, list.data(), owner);
}

/// Makes errors of the library mwmesh.Error of the same kind.
void translate_errors(const py::module_& module) {
  static const py::object raise = module.attr("_error_of");
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(std::move(thrown));
    } catch (const Error& error) {
      const py::object made = raise(static_cast<int>(error.kind()), error.what());
      PyErr_SetObject(py::type::handle_of(made).ptr(), made.ptr());
    }
  });
}

}  // namespace
}  // namespace mwmesh::python

PYBIND11_MODULE(_core, module) {
  using namespace mwmesh::python;
  module.attr("__version__") = mwmesh::version();
  module.attr("stamp") = MW_CORE_STAMP;
  add_space(module);
  add_volume(module);
  add_options(module);
  add_mesh(module);
  add_verdict(module);
  add_runs(module);
  module.def("synth", &synth_array);
  end_runs_at_exit();
  translate_errors(py::module_::import("mwmesh._errors"));
}
