// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/mesh/vtkhdf/vtkhdf_shared.h"

#include "io/file/errors.h"

namespace mw::io {

void VtkhdfShared::create() {
  made_.emplace(path_);
  partial_ = std::filesystem::absolute(made_->partial());
}

void VtkhdfShared::join(const std::string& place) {
  partial_ = place;
  try {
    const JoinedPartial reachable(partial_);
  } catch (const Error& error) {
    throw Error(error.kind(), text(error.what(), "; every process writes a part of this mesh"));
  }
}

void VtkhdfShared::lay_out(const MeshHeader& header, std::uint64_t vertices) {
  header_ = header;
  vertices_ = vertices;
  static_cast<void>(place_vtkhdf(made_->rooms(), Element::kTet4, header.tets));
  static_cast<void>(made_->reserve(vertices * sizeof(Position)));
  made_->extend();
}

void VtkhdfShared::begin(std::uint64_t tets) {
  Hdf5Rooms rooms;
  part_.emplace(partial_);
  columns_ = VtkhdfColumns(*part_, place_vtkhdf(rooms, Element::kTet4, tets), Element::kTet4);
}

void VtkhdfShared::sync() {
  columns_.flush();
  part_->sync();
  part_.reset();
}

void VtkhdfShared::finish() {
  Hdf5Rooms rooms;
  commit_vtkhdf(*made_, place_vtkhdf(rooms, Element::kTet4, header_.tets), Element::kTet4, header_,
                vertices_);
}

}  // namespace mw::io
