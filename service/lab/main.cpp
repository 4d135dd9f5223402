// bleedlab: offline experiments.
#include "service/lab/app.h"

int main(int argc, char** argv) { return bleedsim::lab::runLab(argc, argv); }
