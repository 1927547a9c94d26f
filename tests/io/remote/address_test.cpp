// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/remote/address.h"

#include "tests/expect_error.h"
#include "tests/testing.h"

namespace mw::io {
namespace {

TEST(AddressTest, BucketsBecomeTheirWebAddresses) {
  EXPECT_EQ(web_address("gs://b/p/q/"), "https://storage.googleapis.com/b/p/q");
  EXPECT_EQ(web_address("s3://b/p q"), "https://b.s3.amazonaws.com/p%20q");
  EXPECT_EQ(web_address("s3://b.c/p"), "https://s3.amazonaws.com/b.c/p");
  EXPECT_EQ(web_address("https://h:8/a%20b//"), "https://h:8/a%20b");
  EXPECT_EQ(web_address("https://h/!$%&'()*+,-.:;=@[]_~\"<>\\^`{|}\x7f\xc3\xa9"),
            "https://h/!$%&'()*+,-.:;=@[]_~%22%3C%3E%5C%5E%60%7B%7C%7D%7F%C3%A9");
}

TEST(AddressTest, OnlyKnownSchemesAreAddresses) {
  for (const char* text : {"https://h", "http://h", "gs://b", "s3://b", "HTTP://h", "Gs://b"}) {
    EXPECT_TRUE(is_remote_address(text)) << text;
  }
  for (const char* text : {"", "v.npy", "https:/h", "ftp://h", "/a/https://h", "HTTP"}) {
    EXPECT_FALSE(is_remote_address(text)) << text;
  }
}

TEST(AddressTest, SchemesCountInAnyCase) {
  EXPECT_EQ(web_address("HTTPS://Host/A"), "https://Host/A");
  EXPECT_EQ(web_address("GS://B/p"), "https://storage.googleapis.com/B/p");
  EXPECT_TRUE(is_open_to_all("HTTP://h/p"));
}

TEST(AddressTest, OtherSchemesAreRefusedByTheirNames) {
  for (const char* text : {"v.npy", "a/b://c", "://a", "HTTP://h", "gs://b", "/x/ftp://y"}) {
    EXPECT_NO_THROW(check_scheme(text)) << text;
  }
  for (const std::string scheme : {"ftp://", "file://", "zarr+https://"}) {
    expect_error(ErrorKind::kUsage, {scheme + "...", "https://"},
                 [&] { check_scheme(scheme + "host/path"); });
  }
}

TEST(AddressTest, SecretsAndQueriesAreRefusedAndNotRepeated) {
  for (const char* text :
       {"https://u:secret@h/p", "https://h/p?key=secret", "https://h/p#secret"}) {
    try {
      static_cast<void>(web_address(text));
      FAIL() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kUsage);
      EXPECT_EQ(std::string(error.what()).find("secret"), std::string::npos) << error.what();
    }
  }
}

TEST(AddressTest, PathsGoDownAndUpButNotAboveTheHost) {
  EXPECT_EQ(address_below("https://h/a", "b/./c d"), "https://h/a/b/c%20d");
  EXPECT_EQ(address_below("https://h/a", "/b?c#d%"), "https://h/a/b%3Fc%23d%25");
  EXPECT_EQ(address_below("https://h", "-._~:@!$&'()*+,;=[]"), "https://h/-._~:@!$&'()*+,;=%5B%5D");
  EXPECT_EQ(address_below("https://h/a/b", "../c"), "https://h/a/c");
  EXPECT_EQ(address_below("https://h/a", "../../../c"), "https://h/c");
  EXPECT_EQ(split_address("https://h/a/%zz%2fb%4")->second, "%zz/b%4");
  const auto above = split_address("https://h/a/c%20d");
  ASSERT_TRUE(above.has_value());
  EXPECT_EQ(above->first, "https://h/a");
  EXPECT_EQ(above->second, "c d");
  EXPECT_FALSE(split_address("https://h").has_value());
}

TEST(AddressTest, PlainHttpIsOpenBeyondThisMachine) {
  for (const char* text : {"http://h/p", "http://127.example.org", "http://127.0.0.1.org/a"}) {
    EXPECT_TRUE(is_open_to_all(text)) << text;
  }
  for (const char* text : {"https://h/p", "http://127.0.0.1:80/p", "http://localhost/p",
                           "http://[::1]:8000/p", "http://[::1]"}) {
    EXPECT_FALSE(is_open_to_all(text)) << text;
  }
  for (const char* text : {"https://127.0.0.1:80/p", "https://localhost", "http://[::1]:8000/p"}) {
    EXPECT_TRUE(is_on_this_machine(text)) << text;
  }
  EXPECT_FALSE(is_on_this_machine("https://127.0.0.1.host.org/p"));
}

TEST(AddressTest, ServersDifferByAllBeforeTheirPaths) {
  const std::string first = "https://host.org/a/b";
  for (const char* same : {"https://host.org/a/b", "https://HOST.org/c?d=e", "HTTPS://host.org:443",
                           "https://host.org:443/a#f"}) {
    EXPECT_TRUE(is_same_server(first, same)) << same;
  }
  for (const char* other :
       {"http://host.org/a/b", "https://host.org:8443/a/b", "https://host.org.evil.com/a/b",
        "https://evil.com/host.org/a/b", "https://host.org@evil.com/a/b", "", "/a/b", "host.org"}) {
    EXPECT_FALSE(is_same_server(first, other)) << other;
  }
}

TEST(AddressTest, OriginsAreThoseOfBrowsers) {
  EXPECT_EQ(origin_of("https://Viewer.example/a/b?c#d"), "https://viewer.example");
  EXPECT_EQ(origin_of("HTTPS://viewer.example:443"), "https://viewer.example");
  EXPECT_EQ(origin_of("http://user@localhost:8080/x"), "http://localhost:8080");
  EXPECT_EQ(origin_of("http://viewer.example:443/"), "http://viewer.example:443");
  for (const char* none : {"", "viewer.example", "ftp://viewer.example/", "file:///x", "/x"}) {
    EXPECT_EQ(origin_of(none), "") << none;
  }
}

}  // namespace
}  // namespace mw::io
