// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// An HDF5 file that is written, whole or not at all.
#include "io/mesh/vtkhdf/hdf5_output.h"

#include "io/file/errors.h"

namespace mw::io {

Hdf5Handle hdf5_creation(hid_t of_what) {
  Hdf5Handle properties(H5Pcreate(of_what), &H5Pclose);
  H5Pset_obj_track_times(properties.get(), false);
  return properties;
}

Hdf5Output::Hdf5Output(const std::filesystem::path& path)
    : name_(path.string()), file_(path), target_{.file = &file_, .failure = nullptr} {
  silence_hdf5();
}

void Hdf5Output::open() {
  const Hdf5Handle access = access_through(target_);
  const Hdf5Handle properties = hdf5_creation(H5P_FILE_CREATE);
  hdf5_ = Hdf5Handle(H5Fcreate(name_.c_str(), H5F_ACC_TRUNC, properties.get(), access.get()),
                     &H5Fclose);
  require(hdf5_.valid());
}

Hdf5Handle Hdf5Output::make_group(hid_t place, const char* name) const {
  const Hdf5Handle properties = hdf5_creation(H5P_GROUP_CREATE);
  Hdf5Handle group(H5Gcreate2(place, name, H5P_DEFAULT, properties.get(), H5P_DEFAULT), &H5Gclose);
  require(group.valid());
  return group;
}

void Hdf5Output::require(bool done) const {
  target_.check();
  if (!done) throw Error(ErrorKind::kResource, name_ + ": the HDF5 library failed to write it");
}

void Hdf5Output::commit() {
  require(hdf5_.close());
  file_.commit();
}

}  // namespace mw::io
