/* Nothing, for a library that is only there to be needed. */
extern int mvs_nothing;
int mvs_nothing;
