/* An empty library, a dependency of libHD_needy.so. */
extern int mvs_nothing;
int mvs_nothing;
