import { svelte } from "@sveltejs/vite-plugin-svelte";
import { defineConfig } from "vite";

// names without hashes: the server sends entity tags
export default defineConfig({
  plugins: [svelte()],
  build: {
    target: "es2022",
    modulePreload: { polyfill: false },
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 2000,
    rollupOptions: {
      // a page for runs, one for the editor
      input: ["index.html", "edit.html"],
      output: {
        entryFileNames: "assets/[name].js",
        chunkFileNames: "assets/[name].js",
        assetFileNames: "assets/[name][extname]",
      },
    },
  },
});
