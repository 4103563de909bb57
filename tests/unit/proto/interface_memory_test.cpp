/// Interfaces that stand still travel once.
#include "proto/interface_memory.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "samples.hpp"

namespace fpi::proto {
namespace {

FluidAdvance step_with(const Interface& interface) { return {.time_step = 0.1, .interfaces = {interface}}; }

TEST(InterfaceMemory, ten_steps_with_a_fixed_body_send_one_interface) {
  InterfaceMemory here, there;
  std::size_t travelled = 0;
  for (int step = 0; step < 10; ++step) {
    const FluidAdvance sent = here.sent(step_with(samples::arcs()));
    travelled += sent.interfaces.size();
    EXPECT_EQ(sent.same_interfaces, step > 0);
    const FluidAdvance received = there.received(sent);
    EXPECT_EQ(received.interfaces, std::vector{samples::arcs()});
    EXPECT_FALSE(received.same_interfaces);
    here.accept();
    there.accept();
  }
  EXPECT_EQ(travelled, 1u);
}

TEST(InterfaceMemory, what_was_not_accepted_or_has_changed_is_sent_again) {
  InterfaceMemory here;
  EXPECT_EQ(here.sent(step_with(samples::arcs())).interfaces.size(), 1u);
  EXPECT_EQ(here.sent(step_with(samples::arcs())).interfaces.size(), 1u);  // after a restore
  here.accept();
  Interface faster = samples::arcs();
  faster.translation[0] += 1;
  EXPECT_EQ(here.sent(step_with(faster)).interfaces.size(), 1u);
  EXPECT_TRUE(here.sent(step_with(samples::arcs())).same_interfaces);
}

TEST(InterfaceMemory, the_same_as_nothing_is_refused) {
  InterfaceMemory there;
  EXPECT_THROW(there.received({.same_interfaces = true}), Error);
}

TEST(InterfaceMemory, a_scene_without_bodies_has_nothing_to_repeat) {
  InterfaceMemory here;
  for (int step = 0; step < 2; ++step) {
    EXPECT_FALSE(here.sent({.time_step = 0.1}).same_interfaces);
    here.accept();
  }
}

}  // namespace
}  // namespace fpi::proto
