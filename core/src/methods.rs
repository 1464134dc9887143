#![doc = include_str!(concat!(env!("OUT_DIR"), "/methods.md"))]

#[cfg(test)]
mod tests {
    /// `build.rs` puts the page together.
    #[test]
    fn the_page_of_methods_says_what_each_room_does() {
        let page = include_str!(concat!(env!("OUT_DIR"), "/methods.md"));
        for heading in [
            "# num",
            "## num: root",
            "# fif",
            "# ifs",
            "# curve",
            "## escape: orbit: dwell",
            "# trace",
            "## draw: line",
        ] {
            assert!(page.contains(&std::format!("\n{heading}\n")), "{heading}");
        }
        assert!(page.matches("\n## ").count() > 50 && !page.contains("[`"), "the page is nearly empty");
    }
}
