// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Addresses of remote volumes, and the addresses below and above them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace mw::io {

/// Whether the text begins as a remote address does, with https://, http://, gs:// or s3://, in any
/// case.
[[nodiscard]] bool is_remote_address(std::string_view text);

/// ERRORS: mw::Error(kUsage) naming the scheme where the text begins with one that is not read,
/// such as ftp://.
void check_scheme(std::string_view text);

/// Returns the web address that an address stands for, without '/' at its end: gs://BUCKET/PATH and
/// s3://BUCKET/PATH become those at which Google and Amazon serve public buckets.  The scheme is in
/// lower case.  Blanks and letters beyond ASCII are percent-encoded.
/// REQUIRES: is_remote_address(address).
/// ERRORS: mw::Error(kUsage) without a host or a bucket, and for a user, a password, a query or a
/// fragment in it, as such parts may be secret, and addresses stand in messages and reports.
[[nodiscard]] std::string web_address(std::string_view address);

/// Appends a path, percent-encoded; its parts "." and ".." mean what they do in paths, and do not
/// lead above the host.  REQUIRES: address is one that web_address() returned.
[[nodiscard]] std::string address_below(const std::string& address, std::string_view path);

/// Returns the address of the folder and the name in it, decoded; nothing for the host itself.
[[nodiscard]] std::optional<std::pair<std::string, std::string>> split_address(
    const std::string& address);

/// Whether two web addresses have the same scheme, host and port.
[[nodiscard]] bool is_same_server(const std::string& a, const std::string& b);

/// Returns what browsers call the origin of a page (RFC 6454): scheme, host, and the port unless it
/// is the scheme's own.  It is empty where the address is none of https:// or http://.
[[nodiscard]] std::string origin_of(const std::string& address);

/// Whether the host of an address is this machine, as 127.0.0.1, [::1] and localhost are.
[[nodiscard]] bool is_on_this_machine(const std::string& address);

/// Whether others can read on the way what is sent there, as with http:// to another machine.
[[nodiscard]] bool is_open_to_all(const std::string& address);

}  // namespace mw::io
