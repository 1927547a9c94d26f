// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Addresses as text (RFC 3986).
#include "io/remote/address.h"

#include <curl/curl.h>

#include <algorithm>
#include <array>
#include <memory>
#include <new>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"

namespace mw::io {
namespace {

constexpr std::array<std::string_view, 4> kSchemes{"https://", "http://", "gs://", "s3://"};

/// Returns the scheme of a remote address, in lower case; empty where the text is none.
std::string_view scheme_of(std::string_view text) {
  for (const std::string_view scheme : kSchemes) {
    if (lower_case(text.substr(0, scheme.size())) == scheme) return scheme;
  }
  return {};
}

bool is_letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

/// Returns the text with %HH for each byte that is no letter or digit of ASCII, nor one of `plain`.
std::string percent_encoded(std::string_view text, std::string_view plain) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (is_letter_or_digit(c) || plain.find(c) != plain.npos) {
      out += c;
    } else {
      out += {'%', kDigits[byte >> 4U], kDigits[byte & 15U]};
    }
  }
  return out;
}

/// Encodes what must not stand in a name in a path as it is.
std::string encoded(std::string_view name) {
  return percent_encoded(name, "-._~:@!$&'()*+,;=");
}

/// Encodes only what no address may have, since a user's address may be encoded already.
std::string mended(std::string_view address) {
  return percent_encoded(address, "!#$%&'()*+,-./:;=?@[]_~");
}

std::string decoded(const char* name) {
  int size = 0;
  const std::unique_ptr<char, void (*)(void*)> bytes(curl_easy_unescape(nullptr, name, 0, &size),
                                                     curl_free);
  if (bytes == nullptr) throw std::bad_alloc();
  return {bytes.get(), static_cast<std::size_t>(size)};
}

/// Returns where the path begins.
std::size_t end_of_host(std::string_view address) {
  return std::min(address.find('/', scheme_of(address).size()), address.size());
}

[[noreturn]] void fail_address(std::string_view scheme, std::string_view reason) {
  fail_usage("the address ", scheme, "...: ", reason);
}

/// Puts a bucket with a dot in its name into the path, as the certificate of
/// BUCKET.s3.amazonaws.com does not cover it.
std::string amazon_address(std::string_view bucket, std::string_view path) {
  if (bucket.find('.') != bucket.npos) return text("https://s3.amazonaws.com/", bucket, path);
  return text("https://", bucket, ".s3.amazonaws.com", path);
}

struct FreeUrl {
  void operator()(CURLU* url) const { curl_url_cleanup(url); }
};

/// Returns scheme, host and port of an address, in lower case; the port is empty where the flag
/// says so.  Returns nothing when it is none.  The library that sends the requests takes it apart,
/// as another reading of a strange address could name another host.
std::optional<std::array<std::string, 3>> server_of(const std::string& address, unsigned flag) {
  const std::unique_ptr<CURLU, FreeUrl> url(curl_url());
  if (!url || curl_url_set(url.get(), CURLUPART_URL, address.c_str(), 0) != CURLUE_OK) return {};
  std::array<std::string, 3> out;
  std::size_t at = 0;
  for (const CURLUPart part : {CURLUPART_SCHEME, CURLUPART_HOST, CURLUPART_PORT}) {
    char* found = nullptr;
    const CURLUcode code = curl_url_get(url.get(), part, &found, flag);
    if (code != CURLUE_OK && code != CURLUE_NO_PORT) return {};
    if (found != nullptr) out[at] = lower_case(found);
    ++at;
    curl_free(found);
  }
  return out;
}

}  // namespace

bool is_remote_address(std::string_view address) {
  return !scheme_of(address).empty();
}

void check_scheme(std::string_view text) {
  const std::size_t end = text.find("://");
  if (end == text.npos || end == 0 || is_remote_address(text)) return;
  const std::string_view scheme = text.substr(0, end);
  const auto may_be_in_scheme = [](char c) {
    return is_letter_or_digit(c) || c == '+' || c == '-' || c == '.';
  };
  if (!std::all_of(scheme.begin(), scheme.end(), may_be_in_scheme)) return;
  fail_address(
      io::text(scheme, "://"),
      "this scheme is not read; give an address with https://, http://, gs:// or s3://, or "
      "the path of a file without a scheme");
}

std::string web_address(std::string_view address) {
  const std::string_view scheme = scheme_of(address);
  while (address.size() > scheme.size() && address.back() == '/') address.remove_suffix(1);
  const std::size_t end = end_of_host(address);
  const std::string_view host = address.substr(scheme.size(), end - scheme.size());
  const std::string_view path = address.substr(end);
  if (host.empty())
    fail_address(scheme, "has no host or bucket; expected, such as gs://BUCKET/PATH");
  if (host.find('@') != host.npos) {
    fail_address(scheme,
                 "has a user or a password in it; put them in the file .netrc of your home "
                 "folder, or in the variable MW_HTTP_AUTHORIZATION");
  }
  if (address.find_first_of("?#") != address.npos) {
    fail_address(scheme,
                 "has a query (?) or a fragment (#), to which no names of chunks can be "
                 "appended; give the address of the folder alone");
  }
  if (scheme == "gs://") return mended(text("https://storage.googleapis.com/", host, path));
  if (scheme == "s3://") return mended(amazon_address(host, path));
  return mended(text(scheme, address.substr(scheme.size())));
}

std::string address_below(const std::string& address, std::string_view path) {
  std::string out = address;
  while (!path.empty()) {
    const std::size_t end = std::min(path.find('/'), path.size());
    const std::string_view part = path.substr(0, end);
    path.remove_prefix(std::min(end + 1, path.size()));
    if (part == "..") {
      if (const auto above = split_address(out)) out = above->first;
    } else if (!part.empty() && part != ".") {
      out += "/" + encoded(part);
    }
  }
  return out;
}

std::optional<std::pair<std::string, std::string>> split_address(const std::string& address) {
  const std::size_t host = end_of_host(address);
  const std::size_t slash = address.rfind('/');
  if (host == address.size() || slash < host) return std::nullopt;
  return std::pair(address.substr(0, slash), decoded(address.c_str() + slash + 1));
}

bool is_same_server(const std::string& a, const std::string& b) {
  const auto server = server_of(a, CURLU_DEFAULT_PORT);
  return a == b || (server && server == server_of(b, CURLU_DEFAULT_PORT));
}

std::string origin_of(const std::string& address) {
  const auto server = server_of(address, CURLU_NO_DEFAULT_PORT);
  if (!server) return {};
  const auto& [scheme, host, port] = *server;
  if (scheme != "https" && scheme != "http") return {};
  return text(scheme, "://", host, port.empty() ? "" : ":", port);
}

bool is_on_this_machine(const std::string& address) {
  const std::size_t scheme = scheme_of(address).size();
  const std::string_view host =
      std::string_view(address).substr(scheme, end_of_host(address) - scheme);
  if (host == "[::1]" || host.starts_with("[::1]:")) return true;
  const std::string_view name = host.substr(0, host.find(':'));
  const bool is_number = name.find_first_not_of("0123456789.") == name.npos;
  return name == "localhost" || (is_number && name.starts_with("127."));
}

bool is_open_to_all(const std::string& address) {
  return scheme_of(address) == "http://" && !is_on_this_machine(address);
}

}  // namespace mw::io
