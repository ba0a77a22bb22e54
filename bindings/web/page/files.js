// Addresses and sizes of the files with a hash in their name; written by the build.
export const CACHE = "ehl-explorer";
export const MODULE = { file: "ehl_web_bg.wasm", bytes: 0 };
export const MODELS = {};
