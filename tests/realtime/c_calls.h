// What c_calls.c offers to the test.
#ifndef TACTILE_NET_TESTS_C_CALLS_H
#define TACTILE_NET_TESTS_C_CALLS_H

#include "tactile_net/tactile_net.h"

#ifdef __cplusplus
extern "C" {
#endif

// A program in C: loads the plan, and takes the frames with one taxel left out and back again, with
// a baseline, by a copy, and as they are. 0, or the line where a call did not do what it should.
// tractions and estimates: four frames' each.
int call_everything(const char* path, const double* frame, const double* baseline, size_t taxel,
                    double* tractions, tactile_net_estimate* estimates);

#ifdef __cplusplus
}
#endif

#endif
