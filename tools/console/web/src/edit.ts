import { mount } from "svelte";
import Editor from "./edit/Editor.svelte";
import "./style.css";

mount(Editor, { target: document.getElementById("page")! });
