#![doc = include_str!("../docs/methods.md")]

#[cfg(test)]
mod tests {
    use std::format;
    use std::fs;
    use std::path::{Path, PathBuf};
    use std::string::String;
    use std::vec::Vec;

    /// The paragraphs at the top of a file, without links, whose names mean nothing elsewhere.
    fn opening(path: &Path) -> String {
        let text = fs::read_to_string(path).unwrap();
        let mut out = String::new();
        for line in text.lines().take_while(|line| line.starts_with("//!")) {
            let line = &line[3..];
            assert!(!line.contains("```"), "{}: an example belongs to a public item", path.display());
            let mut rest = line.strip_prefix(' ').unwrap_or(line);
            while let Some(start) = rest.find("[`") {
                let Some(end) = rest[start..].find("`]").map(|end| start + end) else { break };
                out.push_str(&rest[..start]);
                out.push_str(&rest[start + 1..=end]);
                rest = &rest[end + 2..];
                if rest.starts_with('(') {
                    rest = rest.split_once(')').unwrap().1;
                }
            }
            out.push_str(rest);
            out.push('\n');
        }
        out
    }

    /// Rooms in the order of their dependence, and the private files of each.
    fn page() -> String {
        let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        let mut page = String::from(
            "What each file computes, by which formula, from which source and in which format: what the kernels say of themselves.\n",
        );
        for room in ["num", "fif", "ifs", "curve", "escape", "trace", "draw"] {
            let mods = fs::read_to_string(src.join(room).join("mod.rs")).unwrap();
            let is_private = |name: &str| mods.contains(&format!("\nmod {name};"));
            let mut paths: Vec<PathBuf> =
                fs::read_dir(src.join(room)).unwrap().map(|entry| entry.unwrap().path()).collect();
            paths.sort();
            page.push_str(&format!("\n# {room}\n"));
            for path in paths.iter().filter(|path| path.is_file()) {
                let name = path.file_stem().unwrap().to_str().unwrap();
                // `exact` and `testing` are helpers of tests
                if !is_private(name) || mods.contains(&format!("#[cfg(test)]\nmod {name};")) {
                    continue;
                }
                let title = name.replace('_', " ");
                page.push_str(&format!("\n## {room}: {title}\n\n{}", opening(path)));
            }
        }
        page
    }

    /// Changed on purpose? `ATTRACTOR_BLESS=1 cargo test -p attractor --lib methods` writes the page.
    #[test]
    fn the_page_of_methods_is_what_the_files_say() {
        let kept = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/methods.md");
        let now = page();
        assert!(now.matches("\n## ").count() > 50, "the page is nearly empty");
        if std::env::var_os("ATTRACTOR_BLESS").is_some() {
            fs::write(&kept, &now).unwrap();
        }
        let kept = fs::read_to_string(kept).unwrap();
        for (kept, now) in kept.lines().zip(now.lines()) {
            assert_eq!(kept, now, "core/docs/methods.md is not what the files say");
        }
        assert_eq!(kept.lines().count(), now.lines().count());
    }
}
