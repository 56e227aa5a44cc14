// Classic scripts and workers, also of a page opened from disk: the global `libmvs`. Nothing is
// fetched: loadMvs takes the bytes, which the page sends by message.
import { instantiate } from "./library.js";

export * from "./api.js";
export { instantiate as loadMvs };
