#include "tests/realtime/c_calls.h"

#include <math.h>
#include <string.h>

#define EXPECT(condition)          \
  do {                             \
    if (!(condition)) {            \
      tactile_net_destroy(other);  \
      tactile_net_destroy(loaded); \
      return __LINE__;             \
    }                              \
  } while (0)

int call_everything(const char* path, const double* frame, const double* baseline, size_t taxel,
                    double* tractions, tactile_net_estimate* estimates) {
  tactile_net_estimator* other = NULL;
  tactile_net_estimator* loaded = tactile_net_load(TACTILE_NET_INTERFACE, path);
  EXPECT(loaded != NULL);
  const tactile_net_plan* const plan = tactile_net_plan_of(loaded);
  const size_t n = plan->readings;
  EXPECT(tactile_net_set_dead(loaded, taxel));
  EXPECT(tactile_net_update(loaded, frame, n, 0.5, tractions, &estimates[0]) == TACTILE_NET_OK);
  tactile_net_revive(loaded);
  EXPECT(tactile_net_set_baseline(loaded, baseline, n) == TACTILE_NET_OK);
  EXPECT(tactile_net_update(loaded, frame, n, 1.5, tractions + plan->tractions, &estimates[1]) ==
         TACTILE_NET_OK);
  other = tactile_net_copy(loaded);
  EXPECT(other != NULL);
  EXPECT(strcmp(tactile_net_plan_of(other)->label, plan->label) == 0);
  tactile_net_destroy(loaded);
  loaded = NULL;
  EXPECT(tactile_net_update(other, frame, n, 1.5,
                            tractions + 2 * tactile_net_plan_of(other)->tractions,
                            &estimates[2]) == TACTILE_NET_OK);
  tactile_net_destroy(other);
  other = NULL;
  loaded = tactile_net_load(TACTILE_NET_INTERFACE, path);
  EXPECT(tactile_net_update(loaded, frame, n, 2.5, NULL, &estimates[3]) == TACTILE_NET_OK);
  EXPECT(tactile_net_update(loaded, frame, n, 2.5,
                            tractions + 3 * tactile_net_plan_of(loaded)->tractions,
                            NULL) == TACTILE_NET_OK);
  EXPECT(tactile_net_update(loaded, frame, n - 1, 0.0, NULL, NULL) == TACTILE_NET_WRONG_SIZE);
  EXPECT(tactile_net_update(loaded, NULL, n, 0.0, NULL, NULL) == TACTILE_NET_WRONG_SIZE);
  EXPECT(tactile_net_set_baseline(loaded, NULL, n) == TACTILE_NET_WRONG_SIZE);
  tactile_net_destroy(loaded);
  loaded = tactile_net_load(TACTILE_NET_INTERFACE + 1, path);
  EXPECT(loaded == NULL && strstr(tactile_net_last_error(), "tactile_net.h") != NULL);
  tactile_net_destroy(NULL);
  return 0;
}
