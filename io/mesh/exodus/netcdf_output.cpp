// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/mesh/exodus/netcdf_output.h"

#include <netcdf.h>

#include <algorithm>
#include <array>

#include "io/file/errors.h"
#include "kernels/core/error.h"

namespace mw::io {

NetcdfOutput::NetcdfOutput(const std::filesystem::path& path) : name_(path.string()), file_(path) {
  check(nc_create(file_.partial().c_str(), NC_CLOBBER | NC_64BIT_OFFSET, &netcdf_));
  int before = 0;
  check(nc_set_fill(netcdf_, NC_NOFILL, &before));
}

NetcdfOutput::~NetcdfOutput() {
  if (netcdf_ != -1) nc_abort(netcdf_);
}

/// Positive errors are those of the system.
void NetcdfOutput::check(int status) const {
  if (status == NC_NOERR) return;
  if (status > 0) fail_output(name_, "write", status);
  const bool is_too_large = status == NC_EVARSIZE || status == NC_EDIMSIZE;
  throw Error(is_too_large ? ErrorKind::kUsage : ErrorKind::kResource,
              is_too_large ? text(name_, ": the mesh is too large for the format; write .vtkhdf")
                           : text(name_, ": cannot be written: ", nc_strerror(status)));
}

int NetcdfOutput::add_dimension(const std::string& name, std::uint64_t length) {
  int id = 0;
  check(nc_def_dim(netcdf_, name.c_str(), length, &id));
  return id;
}

int NetcdfOutput::add_variable(const std::string& name, int type,
                               const std::vector<int>& dimensions) {
  int id = 0;
  check(nc_def_var(netcdf_, name.c_str(), type, static_cast<int>(dimensions.size()),
                   dimensions.data(), &id));
  return id;
}

int NetcdfOutput::add_integers(const std::string& name, const std::vector<int>& dimensions) {
  return add_variable(name, NC_INT, dimensions);
}

int NetcdfOutput::add_doubles(const std::string& name, const std::vector<int>& dimensions) {
  return add_variable(name, NC_DOUBLE, dimensions);
}

int NetcdfOutput::add_texts(const std::string& name, const std::vector<int>& dimensions) {
  return add_variable(name, NC_CHAR, dimensions);
}

void NetcdfOutput::add_attribute(int variable, const std::string& name, const std::string& value) {
  check(nc_put_att_text(netcdf_, variable, name.c_str(), value.size(), value.data()));
}

void NetcdfOutput::add_attribute(int variable, const std::string& name, int value) {
  check(nc_put_att_int(netcdf_, variable, name.c_str(), NC_INT, 1, &value));
}

void NetcdfOutput::add_attribute(int variable, const std::string& name, float value) {
  check(nc_put_att_float(netcdf_, variable, name.c_str(), NC_FLOAT, 1, &value));
}

void NetcdfOutput::begin_data() {
  check(nc_enddef(netcdf_));
}

void NetcdfOutput::put(int variable, std::uint64_t first, std::span<const int> values,
                       std::size_t columns) {
  if (values.empty()) return;
  const std::array<std::size_t, 2> start{first, 0};
  const std::array<std::size_t, 2> count{values.size() / columns, columns};
  check(nc_put_vara_int(netcdf_, variable, start.data(), count.data(), values.data()));
}

void NetcdfOutput::put(int variable, std::uint64_t first, std::span<const double> values) {
  if (values.empty()) return;
  const std::size_t start = first;
  const std::size_t count = values.size();
  check(nc_put_vara_double(netcdf_, variable, &start, &count, values.data()));
}

void NetcdfOutput::put_text(int variable, std::uint64_t row, const std::string& value,
                            std::size_t max_bytes) {
  std::string padded = value.substr(0, max_bytes);
  padded.resize(max_bytes + 1, '\0');
  const std::array<std::size_t, 2> start{row, 0};
  const std::array<std::size_t, 2> count{1, padded.size()};
  check(nc_put_vara_text(netcdf_, variable, start.data(), count.data(), padded.data()));
}

void NetcdfOutput::commit(AtomicFile& beside) {
  check(nc_close(std::exchange(netcdf_, -1)));
  commit_together({beside, file_});
}

}  // namespace mw::io
