/* A skin whose frames obey friction's cone, in a loop in C99: 12_c_skin_controller PLAN FRAMES,
   which 10_skin_controller PLAN FRAMES writes. Prints each frame's force, its margin, and how far
   it is from its minimum at most. */
#include <stdio.h>
#include <stdlib.h>
#include <tactile_net/tactile_net.h>

int main(int count, char** arguments) {
  if (count != 3) {
    fprintf(stderr, "usage: %s PLAN FRAMES\n", arguments[0]);
    return 2;
  }
  /* Before the loop, everything that allocates or takes long. */
  tactile_net_estimator* const estimator = tactile_net_load(TACTILE_NET_INTERFACE, arguments[1]);
  if (estimator == NULL) {
    fprintf(stderr, "%s\n", tactile_net_last_error());
    return 2;
  }
  const tactile_net_plan* const plan = tactile_net_plan_of(estimator);
  printf("%zu steps towards |q| <= %.1f p\n", plan->steps, plan->friction_limit);
  double* const readings = malloc(plan->readings * sizeof *readings);
  double* const tractions = malloc(plan->tractions * sizeof *tractions);
  FILE* const frames = fopen(arguments[2], "rb");
  if (readings == NULL || tractions == NULL || frames == NULL) return 2;
  tactile_net_prepare(estimator, NULL);

  /* In the loop: no allocation, no lock, no system call but the reading of the file. */
  int slips = 0;
  tactile_net_estimate contact;
  while (fread(readings, sizeof *readings, plan->readings, frames) == plan->readings) {
    if (tactile_net_update(estimator, readings, plan->readings, 0.0, tractions, &contact) !=
        TACTILE_NET_OK)
      return 1;
    for (size_t i = 0; i < plan->rows * plan->columns; ++i)
      if (tractions[i] < 0.0) return 1; /* nothing pulls */
    printf("%.2f N down, %.2f N of drag, margin %.2f N, unfinished %.3f standard deviations\n",
           contact.normal_force, contact.tangential_force, contact.friction_margin,
           contact.unfinished);
    if (contact.friction_margin < 0.0) ++slips;
  }
  fclose(frames);
  free(tractions);
  free(readings);
  tactile_net_destroy(estimator);
  return slips > 0 ? 0 : 1;
}
