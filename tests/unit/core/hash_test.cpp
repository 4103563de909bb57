/// The hash behind fingerprints.
#include "core/hash.hpp"

#include <gtest/gtest.h>

namespace fpi {
namespace {

TEST(Fnv1a, gives_the_published_values) {  // test vectors of RFC 9923
  EXPECT_EQ(fnv1a(""), 0xcbf29ce484222325u);
  EXPECT_EQ(fnv1a("a"), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(fnv1a("foobar"), 0x85944171f73967e8u);
}

}  // namespace
}  // namespace fpi
