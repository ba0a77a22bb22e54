// Addresses of the files with a hash in their name, and their sizes; the build writes them.
export const CACHE = "ehl-explorer";
export const MODULE = { file: "ehl_web_bg.wasm", bytes: 0 };
export const MODELS = {};
